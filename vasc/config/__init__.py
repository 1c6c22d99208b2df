"""Configs: from TOML to checked parameters, and what is wrong with it in one line a problem."""

from vasc.config.bundled import Bundled, bundled_configs, copy_bundled
from vasc.config.loading import Experiment, experiment_from_record, load, load_text
from vasc.config.overrides import Override, parse_override

__all__ = [
    "Bundled",
    "Experiment",
    "Override",
    "bundled_configs",
    "copy_bundled",
    "experiment_from_record",
    "load",
    "load_text",
    "parse_override",
]
