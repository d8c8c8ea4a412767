"""Pictures as PFM files, without packages: rows from the top, each pixel (r, g, b)."""
import array
import sys


def read_pfm(path):
    """Width, height, and the channels as one array of floats."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"PF":
            raise ValueError(f"{path}: not a PFM picture with colors")
        width, height = map(int, file.readline().split())
        is_little = float(file.readline()) < 0
        values = array.array("f", file.read())
    if is_little != (sys.byteorder == "little"):
        values.byteswap()
    if len(values) != 3 * width * height:
        raise ValueError(f"{path}: expected {3 * width * height} numbers, got {len(values)}")
    return width, height, turned_over(values, 3 * width)


def write_pfm(path, width, height, values):
    values = turned_over(array.array("f", values), 3 * width)
    if sys.byteorder != "little":
        values.byteswap()
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode())
        file.write(values.tobytes())


def turned_over(values, row):
    """PFM files begin with the lowest row."""
    result = array.array("f")
    for first in range(len(values) - row, -1, -row):
        result.extend(values[first:first + row])
    return result
