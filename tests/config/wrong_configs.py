"""A sound config, and every way to spoil it: the text, and what its line must say."""

GOOD = {
    "top": 'kind = "closed"\nseed = 1',
    "domain": 'shape = "ovate"\nlength = 20.0',
    "growth": 'kind = "marginal"\nfinal_length = 60.0\nlength_per_step = 2.0',
    "placement": (
        'kind = "darts"\ndensity = 0.002\nbirth_distance_sources = 8.0\nbirth_distance_veins = 8.0'
    ),
    "arrival": "kill_distance = 1.0",
}


def config(**tables):
    """Give a sound config with tables replaced, or left out where None is given."""
    text = ""
    for name, body in (GOOD | tables).items():
        if body is not None:
            text += f"{body}\n" if name == "top" else f"[{name}]\n{body}\n"
    return text


GOOD_TISSUE = {
    "top": 'kind = "canalization"\nseed = 1',
    "domain": 'kind = "rectangular"\ncolumns = 21\nrows = 11',
    "veins": "lines = [[[10.0, 10.0]]]",
    "placement": 'kind = "given"\npoints = [[5.0, 2.0]]',
    "transport": 'kind = "facilitated"',
}


def tissue_config(**tables):
    """Give a sound config of canalization with tables replaced, or left out."""
    return config(**dict.fromkeys(GOOD, None) | GOOD_TISSUE | tables)


BLADE = 'blade = { shape = "ovate", length = 20.0 }'

WRONG_TISSUES = {
    "rows alone": (
        tissue_config(domain="rows = 11"),
        "domain: 'rows' given",
        "either 'columns' and 'rows' or 'blade'",
    ),
    "no cells": (tissue_config(domain='kind = "hexagonal"'), "domain: neither given"),
    "box and blade": (
        tissue_config(domain=f"columns = 21\nrows = 11\n{BLADE}"),
        "'columns' and 'rows' and 'blade' given",
    ),
    "too many cells": (
        tissue_config(domain="columns = 20000\nrows = 20"),
        "columns = 20000 and rows = 20",
        "between 2 and 250,000",
    ),
    "one cell": (tissue_config(domain="columns = 1\nrows = 1"), "between 2 and 250,000"),
    "no column": (
        tissue_config(domain="columns = 0\nrows = 11"),
        "domain.columns = 0",
        "at least 1",
    ),
    "cells of an unknown kind": (
        tissue_config(domain='kind = "triangular"\ncolumns = 21\nrows = 11'),
        'domain.kind = "triangular"',
        '"hexagonal", "rectangular", "voronoi"',
    ),
    "steps of Lloyd for squares": (
        tissue_config(domain="columns = 21\nrows = 11\nlloyd = 3"),
        "domain.lloyd = 3",
        'unknown key for kind "rectangular"',
    ),
    "unknown shape of a tissue": (
        tissue_config(domain='blade = { shape = "ovat", length = 20.0 }'),
        'domain.blade.shape = "ovat"',
        'nearest: "ovate"',
    ),
    "outline of a tissue that is not there": (
        tissue_config(domain='blade = { file = "none.csv", length = 20.0 }'),
        'domain.blade.file = "none.csv"',
        "no such file",
    ),
    "no veins": (tissue_config(veins="lines = []"), "veins: give 'lines' or margin = true"),
    "vein of no point": (tissue_config(veins="lines = [[]]"), "veins.lines[0] = []", "at least 1"),
    "point of one number in a tissue": (
        tissue_config(veins="lines = [[[10.0]]]"),
        "veins.lines[0][0] = [10.0]",
        "2 numbers",
    ),
    "points and file of sources": (
        tissue_config(placement='kind = "given"'),
        "placement: give either 'points' or 'file'",
    ),
    "too few rounds": (
        tissue_config(placement="points = [[5.0, 2.0]]\nrounds = [1, 2]"),
        "'rounds' needs one number for each",
    ),
    "rounds that start late": (
        tissue_config(placement="points = [[5.0, 2.0]]\nrounds = [2]"),
        "placement: 'rounds' hold 2 but not 1",
        "start at 1 and leave none out",
    ),
    "rounds with a gap": (
        tissue_config(placement="points = [[5.0, 2.0], [7.0, 2.0]]\nrounds = [1, 3]"),
        "placement: 'rounds' hold 3 but not 2",
    ),
    "darts that move away": (
        tissue_config(
            placement='kind = "darts"\ncount = 3\nfirst_distance = 1.0\nlast_distance = 2.0'
        ),
        "placement: 'last_distance' is 2",
        "at most 'first_distance', 1",
    ),
    "no darts": (
        tissue_config(
            placement='kind = "darts"\ncount = 0\nfirst_distance = 2.0\nlast_distance = 2.0'
        ),
        "placement.count = 0",
        "at least 1",
    ),
    "no room for carriers": (
        tissue_config(transport='kind = "polar"\nsaturation = 0.05'),
        "transport: 'saturation' is 0.05",
        "greater than 'baseline', 0.1",
    ),
    "saturation of another word": (
        tissue_config(transport='kind = "polar"\nsaturation = "non"'),
        'transport.saturation = "non"',
        'a number or "none"',
    ),
}

WRONG = WRONG_TISSUES | {
    # kinds and tables
    "no kind": (config(top="seed = 1"), "kind: missing", '"open", "closed"'),
    "unknown kind": (config(top='kind = "closd"'), 'kind = "closd"', 'nearest: "closed"'),
    "kind of a wrong type": (config(top="kind = 3"), "kind = 3", '"open", "closed"'),
    "no domain": (config(domain=None), "domain: missing", "[domain]", "length"),
    "no placement": (
        config(placement=None),
        "placement: missing",
        '"darts", "empty_circles", "given"',
    ),
    "no arrival": (config(arrival=None), "arrival: missing", "kill_distance"),
    "table of no kind": (config(growth="final_length = 60.0"), "growth.kind: missing", '"none"'),
    "table of an unknown kind": (
        config(growth='kind = "isogenic"'),
        'growth.kind = "isogenic"',
        '"isogonic", "keyframed", "local_to_global", "marginal", "none"',
        'nearest: "isogonic"',
    ),
    "kind of a table of a wrong type": (
        config(placement="kind = true"),
        "placement.kind = true",
        '"darts", "empty_circles", "given"',
    ),
    "perception of the other model": (
        config(perception='kind = "nearest"'),
        'perception.kind = "nearest"',
        '"relative", "urquhart"',
    ),
    "refinement of an unknown kind": (
        config(refinement='kind = "halving"'),
        'refinement.kind = "halving"',
        '"corner_cutting", "none", "subdivision"',
    ),
    "number in the place of a table": (
        config(top='kind = "closed"\nrecord = 3'),
        "record = 3",
        "must be a table",
    ),
    "text in the place of a table of kinds": (
        config(top='kind = "closed"\nrefinement = "none"'),
        'refinement = "none"',
        'a table with kind one of "corner_cutting", "none", "subdivision"',
    ),
    # keys
    "misspelt key": (
        config(
            placement='kind = "darts"\ndensity = 0.1\nbirth_distance_source = 1.0\n'
            "birth_distance_sources = 1.0\nbirth_distance_veins = 1.0"
        ),
        "placement.birth_distance_source = 1.0",
        "unknown key",
        'nearest: "birth_distance_sources"',
    ),
    "misspelt key at the top": (
        config(top='kind = "closed"\nsede = 1'),
        "sede = 1",
        'nearest: "seed"',
    ),
    "misspelt table": (config(arival="x = 1"), "arival = { x = 1 }", 'nearest: "arrival"'),
    "key of another kind": (
        config(growth='kind = "none"\nfinal_length = 60.0'),
        "growth.final_length = 60.0",
        'unknown key for kind "none"',
        'leave it out, or choose kind "isogonic" or "marginal"',
    ),
    "key of another table": (
        config(arrival="kill_distance = 1.0\nsegment_length = 1.0"),
        "arrival.segment_length = 1.0",
        "belongs in [extension]",
    ),
    "key at the top that belongs in a table": (
        config(top='kind = "closed"\nfinal_length = 60.0'),
        "final_length = 60.0",
        "belongs in [growth]",
    ),
    "key like no other": (
        config(arrival="kill_distance = 1.0\nqqq = 1"),
        "arrival.qqq = 1",
        "allowed: kill_distance",
    ),
    "key that needs quotes": (
        config(arrival='kill_distance = 1.0\n"a b" = 1'),
        'arrival."a b" = 1',
        "unknown key",
    ),
    "missing key": (
        config(growth='kind = "marginal"\nlength_per_step = 2.0'),
        "growth.final_length: missing",
        "a number greater than 0, in D",
    ),
    # types
    "text for a number": (
        config(arrival='kill_distance = "1.0"'),
        'arrival.kill_distance = "1.0"',
        "a number greater than 0, in D",
    ),
    "flag for a number": (
        config(arrival="kill_distance = true"),
        "arrival.kill_distance = true",
        "a number",
    ),
    "shape of the wrong type": (
        config(domain='shape = ["ovate"]\nlength = 20.0'),
        "domain.shape",
        "ovate",
    ),
    "list for a number": (
        config(domain='shape = "ovate"\nlength = [20.0]'),
        "domain.length = [20.0]",
        "a number greater than 0, in D",
    ),
    "table for a number": (
        config(arrival="kill_distance = { value = 1 }"),
        "arrival.kill_distance = { value = 1 }",
        "a number",
    ),
    "fraction for a whole number": (
        config(top='kind = "closed"\nseed = 1.5'),
        "seed = 1.5",
        "a whole number",
    ),
    "whole number as a fraction": (
        config(top='kind = "closed"\nseed = 1.0'),
        "seed = 1.0",
        "a whole number",
    ),
    "number for a text": (config(top='kind = "closed"\ntitle = 3'), "title = 3", "a text"),
    "number for a flag": (
        config(extension="stall_rule = 1"),
        "extension.stall_rule = 1",
        "true or false",
    ),
    "date for a text": (
        config(top='kind = "closed"\ntitle = 2008-01-01'),
        "title = 2008-01-01",
        "a date",
        "quotes",
    ),
    "number for a list": (config(extension="bias = 0.1"), "extension.bias = 0.1", "2 numbers"),
    "pair of one": (config(extension="bias = [0.1]"), "extension.bias = [0.1]", "2 numbers"),
    "pair of three": (
        config(extension="bias = [0.1, 0.1, 0.1]"),
        "extension.bias = [0.1, 0.1, 0.1]",
        "2 numbers",
    ),
    "text in a pair": (
        config(extension='bias = [0.1, "x"]'),
        'extension.bias[1] = "x"',
        "a number",
    ),
    "point of one number": (
        config(domain="points = [[0.0, 0.0], [1.0], [0.0, 1.0]]\nlength = 20.0"),
        "domain.points[1] = [1.0]",
        "2 numbers",
    ),
    "number for seeds": (
        config(domain='shape = "ovate"\nlength = 20.0\nseeds = 3'),
        "domain.seeds = 3",
        "list",
        "or a table",
    ),
    "no seeds": (
        config(domain='shape = "ovate"\nlength = 20.0\nseeds = []'),
        "domain.seeds = []",
        "a list of at least 1",
    ),
    "parameters of no shape": (
        config(domain="file = 'a.csv'\nlength = 20.0\nparameters = { sinus = 0.3 }"),
        "domain: 'parameters' is for shape, not for file",
    ),
    "row of seeds without a count": (
        config(domain='shape = "ovate"\nlength = 20.0\nseeds = { height = 0.1 }'),
        "domain.seeds.count: missing",
        "a whole number of at least 2",
    ),
    "too few seeds in a row": (
        config(domain='shape = "ovate"\nlength = 20.0\nseeds = { count = 1 }'),
        "domain.seeds.count = 1",
        "a whole number of at least 2",
    ),
    "number among printed values": (
        config(printed="values = { D = 1 }"),
        "printed.values.D = 1",
        "a text in quotes",
    ),
    # ranges and choices
    "negative length": (
        config(domain='shape = "ovate"\nlength = -20.0'),
        "domain.length = -20.0",
        "greater than 0, in D",
    ),
    "no density": (
        config(
            placement='kind = "darts"\ndensity = 0\nbirth_distance_sources = 8.0\n'
            "birth_distance_veins = 8.0"
        ),
        "placement.density = 0",
        "greater than 0, in 1/D^2/step",
    ),
    "negative seed": (config(top='kind = "closed"\nseed = -1'), "seed = -1", "of at least 0"),
    "seed of 65 bits": (
        config(top=f'kind = "closed"\nseed = {2**64}'),
        f"seed = {2**64}",
        "64 bits",
    ),
    "enormous seed": (
        config(top=f'kind = "closed"\nseed = {10**4000}'),
        "seed = (about 2^13287)",
        "64 bits",
    ),
    "infinite number": (
        config(arrival="kill_distance = inf"),
        "arrival.kill_distance = inf",
        "finite",
    ),
    "not a number": (
        config(arrival="kill_distance = nan"),
        "arrival.kill_distance = nan",
        "finite",
    ),
    "infinite number in a list": (
        config(extension="bias = [0.0, -inf]"),
        "extension.bias[1] = -inf",
        "finite",
    ),
    "step zero as the last": (
        config(stop="steps = 0"),
        "stop.steps = 0",
        "of at least 1 and of at most 1e+06, in steps",
    ),
    "unknown shape": (
        config(domain='shape = "cordat"\nlength = 20.0'),
        'domain.shape = "cordat"',
        '"elliptic"',
        'nearest: "cordate"',
    ),
    "unknown reading": (
        config(
            placement='kind = "darts"\ndensity = 0.1\nbirth_distance_sources = 8.0\n'
            'birth_distance_veins = 8.0\nreading = "all"'
        ),
        'placement.reading = "all"',
        '"each_step", "largest_blade"',
    ),
    "unknown record": (config(record='perceived = "some"'), 'record.perceived = "some"', '"veins"'),
    "wide exponent": (config(widths="exponent = 50"), "widths.exponent = 50", "at most 20"),
    "unit beyond floats": (
        config(units="segment = 1e160"),
        "units.segment = 1e+160",
        "at least 1e-12 and of at most 1e+12",
    ),
    "empty unit": (config(units='length = ""'), 'units.length = ""', "not empty"),
    # rules between keys
    "kill distance below a segment": (
        config(arrival="kill_distance = 0.5"),
        "arrival.kill_distance is 0.5",
        "at least extension.segment_length (1)",
        "never reach",
    ),
    "blade that would shrink": (
        config(growth='kind = "marginal"\nfinal_length = 10.0\nlength_per_step = 2.0'),
        "growth.final_length is 10",
        "at least domain.length (20)",
    ),
    "reading that needs marginal growth": (
        config(
            growth=None,
            placement='kind = "darts"\ndensity = 0.1\nbirth_distance_sources = 8.0\n'
            'birth_distance_veins = 8.0\nreading = "largest_blade"',
        ),
        "placement.reading is 'largest_blade'",
        "marginal",
    ),
    "two outlines": (
        config(domain='shape = "ovate"\npoints = [[0.0, 0.0]]\nlength = 20.0'),
        "domain",
        "exactly one of 'shape', 'points', 'file'",
    ),
    "no outline": (config(domain="length = 20.0"), "domain", "'shape', 'points', 'file'"),
    "given sources that are not given": (
        config(placement='kind = "given"'),
        "placement",
        "either 'points' or 'file'",
    ),
    "births of other sources": (
        config(placement='kind = "given"\npoints = [[0.0, 5.0]]\nbirths = [1, 2]'),
        "placement",
        "one step for each of 'points'",
    ),
    # files
    "outline that is not there": (
        config(domain='file = "none.csv"\nlength = 20.0'),
        'domain.file = "none.csv"',
        "no such file",
    ),
    "sources that are not there": (
        config(placement='kind = "given"\nfile = "none.csv"'),
        'placement.file = "none.csv"',
        "no such file",
    ),
    "outline that is a folder": (config(domain='file = "."\nlength = 1.0'), "domain.file", "not a"),
    "outline of no possible name": (
        config(domain='file = "a\\u0000b"\nlength = 20.0'),
        'domain.file = "a\\u0000b"',
        "not the name of a file",
    ),
    # TOML
    "no value": ("kind =\n", "line 1, column 7", "not TOML"),
    "open list": (config(extension="bias = [0.1,"), "line 19, column 1", "not TOML"),
    "open text": ('kind = "closed\nseed = 1\n', "line 1, column 15", "not TOML"),
    "key twice": (config(arrival="kill_distance = 1\nkill_distance = 2"), "line 17", "overwrite"),
    "table twice": (config() + "[domain]\nlength = 3.0\n", "line 17", "domain"),
    "no TOML at all": ("<html></html>", "line 1, column 1", "not TOML"),
    "leading zeros": ("seed = 007", "line 1", "not TOML"),
    "deep nesting": ("x = " + "[" * 3000 + "]" * 3000, "nested too deeply"),
    "deep tables": ("a" + ".a" * 3000 + " = 1", "nested too deeply"),
    "number of ten thousand digits": ("seed = " + "9" * 10_000, "too long"),
    "control character": ('kind = "clo\x01sed"', "line 1", "not TOML"),
}
