"""Panels of the checks of leaves: a simulated distribution, curve or number beside a real one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from vasc.render.styles import INK, TEXT_SIZE

LABEL_SIZE = TEXT_SIZE + 1.0
"""Size of the words along an axis, in pt; numbers and notes are of TEXT_SIZE."""

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Suite = Mapping[str, Any]

REAL = "#6f6f6f"
COLORS = ("#3f7d32", "#2166ac", "#d98200", "#8e44ad")
"""Of simulated leaves with areoles, in their order."""
TREE = "#795548"
"""Of open venation, whose branchings are counted together."""
RANGE = "#dde9d2"
"""Behind the values that a check allows."""
FAIL = "#b3261e"
MARKERS = ("o", "s", "^", "v")
LINE = 44
"""Letters in a line above a panel, at most."""


def looks(suite: Suite) -> dict[str, tuple[str, str]]:
    """Give color and marker of each leaf, the real ones in gray."""
    simulated = [name for name in suite["curves"]["degrees"] if name not in suite["curves"]["real"]]
    found = {
        # more leaves than colours have a colour again, with another marker
        name: (COLORS[row % len(COLORS)], MARKERS[(row + row // len(COLORS)) % len(MARKERS)])
        for row, name in enumerate(simulated)
    }
    return found | dict.fromkeys(suite["curves"]["real"], (REAL, "D"))


def tidy(ax: Axes, *, x: str = "", y: str = "") -> None:
    """Give an axis its words, and take away what no one reads."""
    ax.set_xlabel(x, fontsize=LABEL_SIZE)
    ax.set_ylabel(y, fontsize=LABEL_SIZE)
    ax.tick_params(labelsize=TEXT_SIZE)
    ax.spines[["top", "right"]].set_visible(False)


def mark(ax: Axes, number: int, checks: Sequence[Mapping[str, Any]]) -> None:
    """Name the check above a panel; one that fails is red, framed, and says by what.

    One that is open, since a leaf has no such number, names the leaf.

    Parameters
    ----------
    ax : Axes
        A panel that is drawn.
    number : int
        The check.
    checks : sequence of mapping
        What the panel shows of it, of all leaves.
    """
    failed = [one for one in checks if one["pass"] is False]
    if not failed:
        without = dict.fromkeys(one["leaf"] for one in checks if one["pass"] is None)
        is_open = f", open for {', '.join(without)}" if without else ""
        ax.set_title(f"check {number}{is_open}", fontsize=LABEL_SIZE, color=INK, loc="left")
        return
    is_one = len({one["what"] for one in checks}) == 1
    said = [
        line
        for one in failed
        for line in wrap(_missed(one, is_one), LINE, subsequent_indent="    ")
    ]
    ax.set_title(
        "\n".join([f"check {number} FAILS", *said]),
        fontsize=TEXT_SIZE,
        color=FAIL,
        loc="left",
        linespacing=1.25,
    )
    ax.spines[:].set(visible=True, color=FAIL, linewidth=1.8)


def _missed(check: Mapping[str, Any], is_one: bool) -> str:
    """Give leaf, value and what is asked, and what is measured where that is not the only one."""
    what = "" if is_one else check["what"].rsplit(", ", 1)[-1] + " "
    value = "none" if check["value"] is None else f"{check['value']:.3g}"
    upper = " or more" if check["high"] is None else f" to {check['high']:.3g}"
    return f"{check['leaf']}: {what}{value}, asked {check['low']:.3g}{upper}"


def draw_distribution(ax: Axes, suite: Suite, key: str) -> None:
    """Draw shares by class: the real leaf filled, the others as lines."""
    one = suite["distributions"][key]
    for name, (color, _) in looks(suite).items():
        is_real = name in suite["curves"]["real"]
        ax.stairs(
            one["shares"][name],
            one["edges"],
            color="#cfcfcf" if is_real else color,
            fill=is_real,
            linewidth=1.3,
            zorder=1.0 if is_real else 2.0,
        )
    ax.set_xlim(one["edges"][0], one["edges"][-1])
    ax.set_ylim(bottom=0.0)
    tidy(ax, x=one["label"], y="share")


def draw_degrees(ax: Axes, suite: Suite) -> None:
    """Draw the shares of junctions by how many veins meet there."""
    found = looks(suite)
    width = 0.8 / len(found)
    for row, (name, (color, _)) in enumerate(found.items()):
        shares = suite["curves"]["degrees"][name]
        for degree in (3, 4, 5):
            share = shares.get(str(degree), 0.0)
            place = degree + (row - (len(found) - 1) / 2.0) * width
            ax.bar(place, share, width=0.9 * width, color=color)
    ax.axhline(_asked(suite, 6)["low"], color=INK, linewidth=0.8, linestyle=":")
    ax.text(5.4, _asked(suite, 6)["low"] - 0.02, "least for 3", fontsize=TEXT_SIZE,
            ha="right", va="top")  # fmt: skip
    ax.set_xticks([3, 4, 5])
    tidy(ax, x="veins that meet at a junction", y="share of junctions")


def draw_values(ax: Axes, suite: Suite, number: int, what: str, species: str | None = None) -> None:
    """Draw the value of each leaf over the range that a check allows.

    Parameters
    ----------
    ax : Axes
        Where to.
    suite : mapping
        What ``vasc validate leaf --json`` gives.
    number : int
        The check.
    what : str
        The words of the number, as the check has them.
    species : str, optional
        Key of the percentiles of many species, drawn below.
    """
    checks = [one for one in _checks(suite, number) if one["what"] == what]
    found = looks(suite)
    ax.axvspan(checks[0]["low"], checks[0]["high"], color=RANGE, linewidth=0.0)
    rows = []
    for row, check in enumerate(checks):
        rows.append(check["leaf"] if check["value"] is not None else f"{check['leaf']}: none")
        if check["value"] is None:
            continue
        color, marker = found[check["leaf"]]
        edge = color if check["pass"] else FAIL
        ax.plot(check["value"], -row, marker, color=color, markeredgecolor=edge, markersize=6.0,
                markeredgewidth=1.6)  # fmt: skip
        if not check["pass"]:
            place = (check["value"], -row + 0.25)
            ax.text(
                *place, f"{check['value']:.3g} fails", color=FAIL, ha="center", fontsize=TEXT_SIZE
            )
    if species is not None:
        low, left, middle, right, high = suite["curves"]["species"][species]
        row = -len(checks)
        ax.plot([low, high], [row, row], color=REAL, linewidth=1.0)
        ax.plot([left, right], [row, row], color=REAL, linewidth=4.0)
        ax.plot(middle, row, "|", color="white", markersize=7.0, markeredgewidth=1.5)
        rows.append("45 species")
    ax.set_yticks([-row for row in range(len(rows))], rows)
    ax.set_ylim(-len(rows) + 0.4, 0.6)
    tidy(ax, x=what)


def draw_angles(ax: Axes, suite: Suite) -> None:
    """Draw the angle of the two widest veins over the ratio of widths, with the law."""
    law = suite["curves"]["angle_law"]
    ratios, angles = [one["ratio"] for one in law], [one["law"] for one in law]
    ax.plot(ratios, angles, color=INK, linewidth=1.0, linestyle="--", label="balance of forces")
    for name, (color, marker) in looks(suite).items():
        # a class with too few junctions leaves a gap
        found = {one["ratio"]: one["quartiles"] for one in suite["curves"]["angles"][name]}
        rows = [found.get(ratio, (float("nan"),) * 3) for ratio in ratios]
        low, middle, high = zip(*rows, strict=True)
        if name in suite["curves"]["real"]:
            label = f"quartiles of {name}"
            ax.fill_between(
                ratios, low, high, color="#e3e3e3", linewidth=0.0, zorder=0.5, label=label
            )
        ax.plot(ratios, middle, marker=marker, color=color, markersize=4.0, linewidth=1.2)
    ax.set_ylim(85.0, 183.0)
    ax.legend(fontsize=TEXT_SIZE, frameon=False, loc="lower left")
    tidy(ax, x="thinnest over widest vein", y="angle of the two widest (degrees)")


def draw_controls(ax: Axes, suite: Suite, real: str, shuffled: str, words: str) -> None:
    """Draw a number beside the one of its shuffled control, open, for each leaf."""
    # without widths there are no such numbers
    controls = suite["curves"]["controls"]
    found = {
        name: look
        for name, look in looks(suite).items()
        if controls[name][real] is not None and controls[name][shuffled] is not None
    }
    for row, (name, (color, marker)) in enumerate(found.items()):
        one = controls[name]
        ax.plot([one[real], one[shuffled]], [-row, -row], color=color, linewidth=1.0)
        ax.plot(one[real], -row, marker, color=color, markersize=6.0)
        ax.plot(one[shuffled], -row, marker, color="white", markeredgecolor=color, markersize=6.0)
    ax.set_yticks([-row for row in range(len(found))], list(found))
    ax.set_ylim(-len(found) + 0.4, 0.6)
    largest = max((controls[name][key] for name in found for key in (real, shuffled)), default=0.0)
    # room for the whole symbol of the largest number
    ax.set_xlim(0.0, 1.08 * largest or 1.0)
    tidy(ax, x=f"{words}; open: widths shuffled")


def draw_ends(ax: Axes, suite: Suite) -> None:
    """Draw the free ends per areole, and say which leaf was asked for what."""
    asked = {one["leaf"]: one for one in _checks(suite, 10)}
    found = looks(suite)
    for row, (name, (color, _)) in enumerate(found.items()):
        value = suite["curves"]["ends"][name]
        ax.barh(-row, value, height=0.6, color=color)
        words = f"{value:.2f}"
        if name in asked:
            verdict = " FAILS" if asked[name]["pass"] is False else ""
            words += f" ({asked[name]['what'].rsplit(', ', 1)[-1]}{verdict})"
        ax.text(value + 0.02, -row, words, va="center", fontsize=TEXT_SIZE)
    ax.set_yticks([-row for row in range(len(found))], list(found))
    ax.set_xlim(0.0, 1.5 * max(0.1, *suite["curves"]["ends"].values()))
    tidy(ax, x="free ends per areole")


def draw_exponents(ax: Axes, suite: Suite) -> None:
    """Draw how far the exponent at each branching is from the one asked for."""
    import numpy as np

    exponents = np.array(suite["exponents"])
    off = np.maximum(np.abs(exponents - np.median(exponents).round(6)), 1e-16)
    edges = np.arange(-16.5, -4.5)
    ax.stairs(np.histogram(np.log10(off), edges)[0] / len(off), edges, fill=True, color=TREE)
    limit = np.log10(_asked(suite, 14)["high"])
    ax.axvline(limit, color=INK, linewidth=0.8, linestyle=":")
    ax.text(limit - 0.15, 0.0, "most allowed ", rotation=90, ha="right", va="bottom",
            fontsize=TEXT_SIZE)  # fmt: skip
    ticks = list(range(-16, -5, 2))
    ax.set_xticks(ticks, [f"$10^{{{tick}}}$" for tick in ticks])
    tidy(ax, x=f"off the exponent, {len(off):,} branchings of open venation", y="share")


def draw_densities(ax: Axes, suite: Suite) -> None:
    """Draw vein densities over the area of the blade: major veins dashed, minor ones full."""
    found = looks(suite)
    for name, one in suite["curves"]["densities"].items():
        color, marker = found[name]
        areas = [area / one["area"][-1] for area in one["area"]]
        for key, line in (("major", "--"), ("minor", "-")):
            last = one[key][-1]
            # a leaf without such veins at the end has no curve
            values = [value / last if value and last else float("nan") for value in one[key]]
            ax.plot(areas, values, line, color=color, marker=marker, markersize=3.5, linewidth=1.2)
    # of the last doubling of the area
    guide = [0.5, 1.0]
    minor, major = (_asked(suite, 15, what) for what in ("minor", "exponent of major"))
    exponent = (major["low"] + major["high"]) / 2.0
    ax.plot(guide, [area**exponent for area in guide], color=INK, linewidth=2.5, alpha=0.35)
    allowed = (1.0 - minor["high"], 1.0 + minor["high"])
    ax.fill_between(guide, *allowed, color=RANGE, linewidth=0.0, zorder=0.0)
    ax.set(xscale="log", yscale="log", ylim=(0.15, 2.5))
    ax.set_xticks([1 / 16, 1 / 8, 1 / 4, 1 / 2, 1], ["1/16", "1/8", "1/4", "1/2", "1"])
    ax.set_yticks([0.2, 0.5, 1.0, 2.0], ["0.2", "0.5", "1", "2"])
    ax.minorticks_off()
    tidy(ax, x="area of the blade over its last", y="vein density over its last")
    words = "dashed: major, gray line: asked\nfull: minor, green: allowed"
    ax.text(
        0.97,
        0.04,
        words,
        fontsize=TEXT_SIZE,
        transform=ax.transAxes,
        ha="right",
        va="bottom",
    )


def draw_other_program(ax: Axes, suite: Suite) -> None:
    """Draw our numbers of the real leaf over those of another program."""
    checks = _checks(suite, 17)
    ax.axvspan(-1.0, 1.0, color=RANGE, linewidth=0.0)
    for row, check in enumerate(checks):
        expected = (check["low"] + check["high"]) / 2.0
        color = REAL if check["pass"] else FAIL
        ax.plot(100.0 * (check["value"] / expected - 1.0), -row, "D", color=color, markersize=4.0)
    ax.set_yticks([-row for row in range(len(checks))], [check["what"] for check in checks])
    ax.set_xlim(-2.0, 2.0)
    tidy(ax, x="percent off another program")
    ax.margins(y=0.03)


def _checks(suite: Suite, number: int) -> Sequence[Mapping[str, Any]]:
    """Give the checks of a number."""
    return [one for one in suite["checks"] if one["check"] == number]


def _asked(suite: Suite, number: int, what: str = "") -> Mapping[str, Any]:
    """Give the first check of a number whose words begin so."""
    return next(one for one in _checks(suite, number) if one["what"].startswith(what))
