"""Rule S2 of tests/support/statistics/rules.h: two renderings have the same mean, as a whole and tile by tile, and the
comparison had the power to see a difference.

`ALPHA` is the probability of a false alarm of one decision, `Z_ALPHA` the normal quantile of 1 - ALPHA / 2. A difference
of `delta` of the mean is eight standard errors.
"""
import math

ALPHA = 1e-6
Z_ALPHA = 4.8916
LEAST_BATCHES = 64
TILE = 16


class Moments:
    def __init__(self, values):
        self.count = len(values)
        self.mean = math.fsum(values) / self.count
        squares = math.fsum((x - self.mean) ** 2 for x in values)
        self.variance_of_mean = squares / (self.count - 1) / self.count


def tile_means(width, height, values):
    """Means of one channel of a picture: of the whole, then of tiles, row by row."""
    columns = (width + TILE - 1) // TILE
    sums = [0.0] * (columns * ((height + TILE - 1) // TILE))
    counts = [0] * len(sums)
    for y in range(height):
        for x in range(width):
            tile = y // TILE * columns + x // TILE
            sums[tile] += values[y * width + x]
            counts[tile] += 1
    return [math.fsum(sums) / (width * height)] + [s / n for s, n in zip(sums, counts)]


def chi_squared_tail(x, freedom):
    """Probability of a larger value: the regularized upper incomplete gamma function.   [Numerical Recipes, 6.2]"""
    a, z = freedom / 2, x / 2
    if z <= 0:
        return 1.0
    scale = math.exp(a * math.log(z) - z - math.lgamma(a))
    if z < a + 1:
        term = total = 1 / a
        n = a
        while term > total * 1e-16:
            n += 1
            term *= z / n
            total += term
        return 1 - scale * total
    b, c, d = z + 1 - a, 1e300, 1 / (z + 1 - a)
    fraction = d
    for i in range(1, 10000):
        an = -i * (i - a)
        b += 2
        d = 1 / ((an * d + b) or 1e-300)
        c = (b + an / c) or 1e-300
        fraction *= d * c
        if abs(d * c - 1) < 1e-15:
            break
    return scale * fraction


class Comparison:
    """Of the batches of two renderings, each a list of tile_means()."""

    def __init__(self, ours, theirs):
        a, b = ([Moments([batch[i] for batch in batches]) for i in range(len(ours[0]))] for batches in (ours, theirs))
        self.batches = min(a[0].count, b[0].count)
        scale = abs(a[0].mean + b[0].mean) / 2
        error = math.sqrt(a[0].variance_of_mean + b[0].variance_of_mean)
        self.means = a[0].mean, b[0].mean
        self.difference = (a[0].mean - b[0].mean) / scale
        self.error = error / scale
        self.z = (a[0].mean - b[0].mean) / error if error > 0 else math.inf
        squares = []
        self.largest = 0.0
        for left, right in zip(a[1:], b[1:]):
            variance = left.variance_of_mean + right.variance_of_mean
            if variance > 0:
                squares.append((left.mean - right.mean) ** 2 / variance)
            middle = abs(left.mean + right.mean) / 2
            if middle > 0:
                self.largest = max(self.largest, abs(left.mean - right.mean) / middle)
        self.tail = chi_squared_tail(math.fsum(squares), len(squares)) if squares else 0.0

    def resolves(self, delta):
        return self.batches >= LEAST_BATCHES and self.error <= delta / 8

    def verdict(self, delta):
        """"pass"; "fail": the means differ; "inconclusive": a difference of `delta` might not have been seen."""
        if not (abs(self.z) <= Z_ALPHA and self.tail >= ALPHA):
            return "fail"
        return "pass" if self.resolves(delta) else "inconclusive"

    def verdict_within(self, low, high, delta):
        """For models that differ: "pass" if the interval of the difference of the whole overlaps [low, high]."""
        half = Z_ALPHA * self.error
        if not (self.difference + half >= low and self.difference - half <= high):
            return "fail"
        return "pass" if self.resolves(delta) else "inconclusive"
