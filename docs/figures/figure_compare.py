"""Whether a picture or a text is still what its commands draw."""

import difflib

from figure_table import Problem

# Of `compare = "plot"`. A browser of another version smooths edges differently, and its text may have another font. Text
# and grid are grey, and what is plotted is coloured.
COLOURED = 40  # of 255: the least difference between the channels of a coloured pixel
NEAR = 2       # pixels: how far away a pixel of the same colour may be
LIKE = 48      # of 255: how different the channels of the same colour may be
STRAY = 1e-3   # the share of coloured pixels that may have no such pixel


def read(path):
    with open(path, "rb") as file:
        return file.read()


def difference(old, new, how):
    """Why the pictures in the files `old` and `new` are not the same, or "". `how`: "bits", the same pixels (of an SVG: the
    same text), or "plot", coloured pixels at nearly the same places."""
    before, after = read(old), read(new)
    if before == after:
        return ""
    if not new.endswith(".png"):
        return text_difference(before.decode(errors="replace"), after.decode(errors="replace"))
    try:
        from PIL import Image, ImageChops
    except ImportError:
        raise Problem("python3-pil is missing: it compares pictures (./run figures installs it)") from None
    with Image.open(old) as file:
        first = file.convert("RGB")
    with Image.open(new) as file:
        second = file.convert("RGB")
    if first.size != second.size:
        return "its size is {} x {}, and not {} x {}".format(*first.size, *second.size)
    differing = sum(ImageChops.difference(first, second).convert("L").point(lambda v: v > 0 and 255).histogram()[1:])
    if how == "bits" or differing == 0:
        return f"{differing} of {first.size[0] * first.size[1]} pixels differ" if differing else ""
    stray = max(stray_share(first, second), stray_share(second, first))
    return f"{stray:.2%} of the coloured pixels have none of their colour near them in the other" if stray > STRAY else ""


def stray_share(picture, other):
    """The share of the coloured pixels of `picture` that are unlike all pixels of `other` in their neighbourhood: each
    channel outside the range of the neighbourhood, widened by LIKE."""
    from PIL import Image, ImageChops, ImageFilter
    size = 2 * NEAR + 1
    lowest, highest = (other.filter(kind(size)).split() for kind in (ImageFilter.MinFilter, ImageFilter.MaxFilter))
    channels = picture.split()
    unlike = Image.new("L", picture.size)
    for channel, low, high in zip(channels, lowest, highest):
        for beyond in (ImageChops.subtract(low, channel), ImageChops.subtract(channel, high)):
            unlike = ImageChops.lighter(unlike, beyond.point(lambda v: 255 if v > LIKE else 0))
    red, green, blue = channels
    most = ImageChops.lighter(ImageChops.lighter(red, green), blue)
    least = ImageChops.darker(ImageChops.darker(red, green), blue)
    coloured = ImageChops.subtract(most, least).point(lambda v: 255 if v > COLOURED else 0)
    stray = ImageChops.darker(coloured, unlike).histogram()[255]
    return stray / max(1, coloured.histogram()[255])


def text_difference(before, after):
    """The first line in which two texts differ, or ""."""
    for line in difflib.unified_diff(before.splitlines(), after.splitlines(), "", "", lineterm="", n=0):
        if line[:1] in "+-" and line[:3] not in ("---", "+++"):
            what = "it lacks" if line[0] == "+" else "it has"
            return f"{what} the line: {line[1:].strip()[:80]}"
    return "" if before == after else "its ends of lines differ"
