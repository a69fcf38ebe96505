"""Pictures reduced to means: over the whole picture and over 4 x 4 blocks of it, each in red, green and blue.
Both sides of a comparison use this code, so it needs nothing beyond Python."""

COLUMNS = 4
ROWS = 4


def block_means(values, width, height, top_first):
    """`values`: red, green, blue of each pixel, row by row. Returns a flat list: the whole picture's three
    means, then those of the blocks, from the top left."""
    bounds_x = [width * i // COLUMNS for i in range(COLUMNS + 1)]
    bounds_y = [height * i // ROWS for i in range(ROWS + 1)]
    means = []
    for row in range(ROWS):
        for left, right in zip(bounds_x, bounds_x[1:]):
            sums = [0.0, 0.0, 0.0]
            for y in range(bounds_y[row], bounds_y[row + 1]):
                line = y if top_first else height - 1 - y
                begin, end = 3 * (line * width + left), 3 * (line * width + right)
                for channel in range(3):
                    sums[channel] += sum(values[begin + channel:end:3])
            count = (right - left) * (bounds_y[row + 1] - bounds_y[row])
            means.append((count, [each / count for each in sums]))
    total = sum(count for count, _ in means)
    whole = [sum(count * mean[channel] for count, mean in means) / total for channel in range(3)]
    return whole + [value for _, mean in means for value in mean]


def name_of(index):
    """Of one mean of block_means, for messages."""
    channel = ("red", "green", "blue")[index % 3]
    if index < 3:
        return f"whole picture, {channel}"
    block = index // 3 - 1
    return f"block {block % COLUMNS + 1} of row {block // COLUMNS + 1}, {channel}"
