"""Draws the pictures of ./run conformance side by side: sheet.py FOLDER GOLDENS OUT.png. For each scene the golden, the
mean of the pictures of each renderer, and its difference from the golden in standard errors."""

import glob
import os
import sys

import mitsuba
import numpy as np
from PIL import Image, ImageDraw

mitsuba.set_variant("scalar_rgb")

SHOWN = ("mitsuba", "luxcore")
TITLES = ("golden", "Mitsuba", "LuxCore", "M - golden", "L - golden")
SIDE, GAP, TEXT, COLUMNS = 64, 2, 12, 2
LARGEST = 6  # standard errors


def layers(path):
    """The layers of an EXR or PFM file, by name; "" is the picture."""
    return {name.replace("<root>", ""): np.array(each)[..., :3] for name, each in mitsuba.Bitmap(path).split()}


def srgb(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def z_values(mean, error, golden):
    """Differences in standard errors, in the channel in which they are largest. Where neither picture has noise, a
    difference beyond what floats round off counts as the largest."""
    scale = np.sqrt(error**2 + golden["se"] ** 2 + (1e-5 * golden[""]) ** 2) + 1e-9 * golden[""].max()
    z = (mean - golden[""]) / scale
    worst = np.abs(z).argmax(-1)
    return np.take_along_axis(z, worst[..., None], -1)[..., 0]


def colours(z):
    """White for up to 2 standard errors, then redder where the picture is brighter, bluer where it is darker."""
    steps = np.clip(np.trunc(np.abs(z)) - 1, 0, LARGEST - 1) / (LARGEST - 1)
    fade = 1 - steps
    one = np.ones_like(fade)
    return np.where((z > 0)[..., None], np.stack([one, fade, fade], -1), np.stack([fade, fade, one], -1))


def tiles(folder, goldens, scene):
    """The pictures of a scene, 0 to 1; None where there is none."""
    golden = layers(os.path.join(goldens, scene + ".exr"))
    brightness = golden[""].max(-1)
    exposure = 0.8 / max(np.percentile(brightness, 95), 1e-30)
    pictures, differences = [srgb(exposure * golden[""])], []
    for name in SHOWN:
        files = [each for ending in ("exr", "pfm") for each in glob.glob(os.path.join(folder, scene, name, "*." + ending))]
        if len(files) < 2:
            pictures.append(None)
            differences.append(None)
            continue
        all_pictures = np.stack([layers(file)[""] for file in files]).astype(float)
        mean, error = all_pictures.mean(0), all_pictures.std(0, ddof=1) / len(files) ** 0.5
        pictures.append(srgb(exposure * mean))
        differences.append(colours(z_values(mean, error, golden)))
    return pictures + differences


def main(folder, goldens, out):
    scenes = sorted(os.path.splitext(each)[0] for each in os.listdir(goldens) if each.endswith(".exr"))
    drawn = {scene: tiles(folder, goldens, scene) for scene in scenes}
    drawn = {scene: row for scene, row in drawn.items() if any(tile is not None for tile in row[1:])}
    rows = -(-len(drawn) // COLUMNS)
    width, height = len(TITLES) * (SIDE + GAP) + 4 * GAP, SIDE + TEXT + 2 * GAP
    sheet = Image.new("RGB", (COLUMNS * width, TEXT + rows * height), "white")
    pen = ImageDraw.Draw(sheet)
    for column in range(COLUMNS):
        for number, title in enumerate(TITLES):
            pen.text((column * width + number * (SIDE + GAP), 0), title, "black")
    for number, (scene, row) in enumerate(drawn.items()):
        x, y = number // rows * width, TEXT + number % rows * height
        pen.text((x, y), scene, "black")
        for tile in row:
            if tile is not None:
                sheet.paste(Image.fromarray(np.uint8(255 * tile + 0.5)), (x, y + TEXT + GAP))
            x += SIDE + GAP
    sheet.quantize(256, dither=Image.Dither.NONE).save(out, optimize=True)  # a third of the size


main(*sys.argv[1:])
sys.stdout.flush()
os._exit(0)  # the destructors of some libraries crash at the end of the interpreter
