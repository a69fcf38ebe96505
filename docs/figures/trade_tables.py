"""trade_tables.py FILE.json.gz...: the tables and sentences of docs/results/trade.md, from what `./run measure trade` keeps."""

import gzip
import json
import sys

# Column: knob, value, and for the heading what it is divided by.
COLUMNS = (
    ("integrator", "bdpt", "bdpt / path"),
    ("integrator", "light", "light / path"),
    ("device", "ref", "ref / host"),
    ("threads", "2", "2 threads / 1"),
    ("tree", "morton63", "radix tree 63 / H-PLOC"),
    ("kernel-needs", "all", "kernels for everything / for the scene"),
    ("ref-tree", "morton63", "ref: radix tree 63 / sah-leaf"),
)
SCENES = {
    "cornell_diffuse": "A closed room of diffuse walls with a lamp that is easy to hit.",
    "cornell_glass": "The same with a ball of mirror and one of glass.",
    "mesh_knot": "A rope of 20,480 triangles in a lit room.",
    "ceiling_lamp": "A room that a lamp in a bowl lights by way of the ceiling: paths from the eye rarely find the light.",
    "door_ajar": "A room that is lit through a gap.",
    "sphere_over_plane": "A sphere that emits over a plane.",
}


def estimate(value):
    """"2.45 (2.17 to 2.76)", with three digits."""
    return f"{value['value']:.3g} ({value['low']:.3g} to {value['high']:.3g})"


def cell(study, knob, value):
    [found] = [one for entry in study["knobs"] if entry["name"] == knob for one in entry["values"] if one["value"] == value]
    [configuration] = [one for one in study["configurations"] if one["name"] == found["configuration"]]
    if configuration["problem"]:
        return f"not measured: {configuration['problem']}"
    biased = " (biased)" if configuration["bias"]["verdict"] == "biased" else ""
    return estimate(found["time_to_equal_noise"]) + biased


def table(studies):
    yield "| scene | " + " | ".join(heading for _, _, heading in COLUMNS) + " |"
    yield "|" + "---|" * (len(COLUMNS) + 1)
    for study in studies:
        yield f"| {study['scene']['name']} | " + " | ".join(cell(study, knob, value) for knob, value, _ in COLUMNS) + " |"


def section(study):
    name, truth = study["scene"]["name"], study["truth"]
    sentences = {knob["name"]: knob["sentence"] for knob in study["knobs"]}
    yield from ("", f"### {name}", "")
    yield (f"{SCENES[name]} {len(study['configurations'])} configurations; truth of {truth['samples']:.0f} samples per pixel, its mean "
           f"known within {100 * truth['whole_error']:.2g}%; median half width of a ratio of times "
           f"{100 * study['noise_of_machine']['half_width']:.2g}%.")
    yield ""
    for knob in ("integrator", "max-edges"):
        yield f"- *{knob}*: {sentences[knob]}"
    yield from ("", f"![Time against error of {name}](../images/trade_{name}.png)")


def one_of_all(studies, what, get):
    """What must be the same in all studies of the page."""
    values = sorted({get(study) for study in studies})
    if len(values) != 1:
        sys.exit(f"trade_tables: the studies differ in {what}: {', '.join(map(str, values))}")
    return values[0]


def main(paths):
    studies = []
    for path in paths:
        with gzip.open(path, "rt", encoding="utf-8") as file:
            studies.append(json.load(file))
    processor = one_of_all(studies, "processor", lambda study: study["machine"]["processor"])
    threads = one_of_all(studies, "threads", lambda study: study["machine"]["threads"])
    rounds = one_of_all(studies, "rounds", lambda study: study["rounds"])
    seconds = one_of_all(studies, "seconds", lambda study: study["seconds"])
    size = one_of_all(studies, "size", lambda study: f"{study['width']} x {study['height']}")
    dates = sorted({study["date"] for study in studies})
    print(f"Measured on {processor}, {threads} threads, {' and '.join(dates)}; {size} pixels, {rounds} rounds in {seconds:.0f} seconds.\n")
    print("The time to equal noise, as a multiple of that of the reference of each knob (path tracing, the fast path, one thread, "
          "H-PLOC, kernels for the scene; for the last column the tree `sah-leaf` of the reference), with 95% intervals:\n")
    print("\n".join(table(studies)))
    for study in studies:
        print("\n".join(section(study)))


if __name__ == "__main__":
    main(sys.argv[1:])
