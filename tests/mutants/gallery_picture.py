"""One picture of the gallery: right, wrong, and their difference, side by side."""

import math
import os
import sys

from PIL import Image

sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "peers"))
from plumbline import read_pfm  # noqa: E402

GAP = 4  # pixels
FULL = 0.5  # relative difference of full colour
DARK = 0.05  # of the mean brightness: where the right picture is darker, differences are relative to this


def srgb(value):
    """IEC 61966-2-1, 0 to 255."""
    value = min(max(value, 0.0), 1.0)
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


def exposure(values):
    """The factor that makes the brightness of all but 5% of the pixels at most 0.8."""
    brightness = sorted(max(values[i:i + 3]) for i in range(0, len(values), 3))
    return 0.8 / max(brightness[int(0.95 * (len(brightness) - 1))], 1e-30)


def shown(values, factor):
    return [tuple(srgb(factor * value) for value in values[i:i + 3]) for i in range(0, len(values), 3)]


def luminance(values, i):
    return 0.2126 * values[i] + 0.7152 * values[i + 1] + 0.0722 * values[i + 2]


def differences(right, wrong):
    """For each pixel, white where both agree, red where the wrong picture is brighter, blue where it is darker."""
    count = len(right) // 3
    floor = DARK * sum(luminance(right, 3 * i) for i in range(count)) / count
    colours = []
    for i in range(0, len(right), 3):
        base = luminance(right, i)
        relative = (luminance(wrong, i) - base) / max(base, floor, 1e-30)
        if not math.isfinite(relative):
            colours.append((0, 0, 0))
            continue
        faded = round(255 * (1 - min(abs(relative) / FULL, 1)))
        colours.append((255, faded, faded) if relative > 0 else (faded, faded, 255))
    return colours


def draw(right_pfm, wrong_pfm, width, height, path):
    """Writes the picture. Both are PFM files of this size; wrong_pfm may be None: no picture came of it."""
    right = read_pfm(right_pfm)
    factor = exposure(right)
    tiles = [shown(right, factor)]
    if wrong_pfm is not None:
        wrong = read_pfm(wrong_pfm)
        tiles += [shown(wrong, factor), differences(right, wrong)]
    sheet = Image.new("RGB", (3 * width + 2 * GAP, height), "white")
    for number, pixels in enumerate(tiles):
        tile = Image.new("RGB", (width, height))
        tile.putdata(pixels)
        # PFM begins with the bottom row.
        sheet.paste(tile.transpose(Image.Transpose.FLIP_TOP_BOTTOM), (number * (width + GAP), 0))
    sheet.quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)
