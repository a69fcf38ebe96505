"""The tables of docs/results/conformance.md."""

MARK = "<!-- conformance: {} -->"


def write_page(path, results):
    """Replaces what is between the marks of the page. What was not measured stays as it is."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for name, found in results["renderers"].items():
        text = between(text, name, scenes(found, results))
    for name, write in EXPLAINED.items():
        if name in results.get("explained", {}):
            text = between(text, name, write(results["explained"][name]))
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def between(text, name, new):
    """`text` with `new` between the marks "begin NAME" and "end NAME"."""
    begin, end = MARK.format("begin " + name), MARK.format("end " + name)
    if text.count(begin) != 1 or text.count(end) != 1:
        raise ValueError(f"not exactly one {begin} and {end}")
    head, _, rest = text.partition(begin)
    return head + begin + "\n" + new + "\n" + end + rest.partition(end)[2]


def scenes(found, results):
    lines = [f"{found['version']}, {results['date']}, {results['processor']}:", "",
             "| scene | pictures, samples | verdict | ratio | 99% interval | smallest visible error |",
             "|---|---|---|---|---|---|"]
    for scene in found["scenes"]:
        if "whole" not in scene:
            lines.append(f"| `{scene['scene']}` | - | {scene['verdict']} | | | {scene['reason']} |")
            continue
        lines.append(row(scene))
    return "\n".join(lines)


def row(scene):
    """The ratio is that of the channel that is farthest from 1; the smallest visible error that of the worst."""
    farthest = max((each for each in scene["whole"] if each["ratio"] is not None), key=lambda each: abs(each["ratio"] - 1),
                   default=None)
    ratio, interval = "", ""
    if farthest:
        ratio = f"{farthest['ratio']:.4f}"
        interval = f"{farthest['low']:.4f} to {farthest['high']:.4f}"
    known = [each for each in scene["detectable"] if each is not None]
    error = f"{max(known):.2%}" if len(known) == len(scene["detectable"]) else "unknown"
    samples = f"{scene['pictures']} of {scene['samples']}" + (f", `{scene['integrator']}`" if scene["integrator"] else "")
    return f"| `{scene['scene']}` | {samples} | {scene['verdict']} | {ratio} | {interval} | {error} |"


def ball(rows):
    lines = ["| at most so many edges | predicted excess | measured excess |", "|---|---|---|"]
    for each in rows:
        lines.append(f"| {each['edges']} | {each['predicted']:+.3%} | {each['measured']:+.3%} ± {each['error']:.3%} |")
    return "\n".join(lines)


def lamp(found):
    return (f"Of {found['segments']} random segments from the walls to the luminaire, {found['unblocked']} miss the bowl, and "
            f"{found['blocked_too_late']} meet it only in their last 0.089%. In Mitsuba's picture of paths of at most 2 edges, "
            f"{found['lit']} of the {found['pixels']} pixels below row {found['rows_below']}, all of which show walls and "
            f"floor, are not black. Their light is {found['share']:.3%} of the whole picture's.")


def pixel(found):
    direct, everything = found["direct"], found["all"]
    return (f"By the closed form the sphere fills {found['share']:.3%} of the area of pixel ({found['x']}, {found['y']}): "
            f"{found['hits']:.2f} of 4096 samples are expected to show it, and their blue light is {found['predicted']:.6f}. "
            f"8 million samples of Mitsuba's in this pixel give {direct['mean']:.6f} ± {direct['error']:.6f} at 2 edges, and "
            f"{everything['mean']:.5f} ± {everything['error']:.5f} at 6.")


def roulette(rows):
    lines = ["| roulette from depth | red of the whole picture |", "|---|---|"]
    for each in rows:
        lines.append(f"| {each['depth'] or 'none'} | {each['mean']:.4f} ± {each['error']:.4f} |")
    return "\n".join(lines)


def lifted(rows):
    lines = ["| renderer | lights moved by | pictures, samples | verdict | ratio | 99% interval | smallest visible error |",
             "|---|---|---|---|---|---|---|"]
    return "\n".join(lines + [row({**each, "scene": each["renderer"]}).replace("` |", f"` | {each['distance']} |", 1)
                              for each in rows])


EXPLAINED = {"ball": ball, "lamp": lamp, "pixel": pixel, "roulette": roulette, "lifted": lifted}
