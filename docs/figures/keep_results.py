"""keep_results.py FROM TO [--only AXIS... | --without AXIS...]: what the pictures and tables of docs/ need of the JSON of `plumbline extremes` or `plumbline
trade`, compressed. The repository keeps it, so that the pictures can be drawn without measuring again."""

import gzip
import json
import sys

POINT = ("parameter", "cases", "errors", "median", "largest", "failures", "not_walked")


def short(value):
    """Numbers with six digits: more than any picture or table shows."""
    return float(f"{value:.6g}") if isinstance(value, float) else value


def kept_point(point):
    """A point without what is 0 or empty, which is the default (extremes/results.cpp: point_from). The parameter stays as it
    is, because points are found by it."""
    return {key: point[key] if key == "parameter" else short(point[key]) for key in POINT if key == "parameter" or point.get(key)}


def kept_extremes(results):
    """The points. Everything else of an axis is in the program."""
    return {**{key: value for key, value in results.items() if key != "axes"},
            "axes": [{"name": axis["name"],
                      "methods": [{"name": method["name"], "points": [kept_point(point) for point in method["points"]]}
                                  for method in axis["methods"]]} for axis in results["axes"]]}


def kept_trade(results):
    """All but the pictures and the measurements of single rounds, which only --resume needs."""
    return {**results, "configurations": [{key: value for key, value in one.items() if key not in ("picture", "raw")}
                                          for one in results["configurations"]]}


def lines(value, depth):
    """JSON with a line for each value at this depth, so that changes are seen line by line."""
    if depth == 0 or not isinstance(value, (dict, list)) or not value:
        return json.dumps(value, separators=(",", ":"))
    if isinstance(value, dict):
        return "{\n" + ",\n".join(f"{json.dumps(key)}:{lines(item, depth - 1)}" for key, item in value.items()) + "\n}"
    return "[\n" + ",\n".join(lines(item, depth - 1) for item in value) + "\n]"


def main(source, target, which="", *axes):
    with open(source, encoding="utf-8") as file:
        results = json.load(file)
    if results.get("complete") is False:
        sys.exit(f"{source}: the measurement was interrupted, so it is not kept")
    extremes = "axes" in results
    if which:
        results["axes"] = [one for one in results["axes"] if (one["name"] in axes) == (which == "--only")]
    text = lines(kept_extremes(results) if extremes else kept_trade(results), 6 if extremes else 2) + "\n"
    with open(target, "wb") as file:
        file.write(gzip.compress(text.encode(), mtime=0))


if __name__ == "__main__":
    main(*sys.argv[1:])
