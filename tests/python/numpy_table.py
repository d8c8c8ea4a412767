"""The program's own learning of tables, in NumPy: the same arithmetic in float32, in the same order, so the same bits."""

import numpy as np

F = np.float32


def in_order(values, axis):
    """Sum from the first to the last, as np.sum does not."""
    return np.add.accumulate(values, axis=axis, dtype=F).take(-1, axis=axis)


class NumpyTable:
    """Forgetful averages of the training samples, smoothed over neighboring cells."""

    PRIOR = F(2)
    PART = 100  # volumes, whose arrays stay in the caches of the processor

    def update(self, samples):
        parts = [slice(i, i + self.PART) for i in range(0, len(samples.counts), self.PART)]
        return np.concatenate([self.update_part(samples, part) for part in parts])

    def update_part(self, samples, part):
        counts, known, visits = samples.counts[part], samples.radiance[part], samples.visits[part]
        count = counts.astype(F)
        mean = samples.sums[part].astype(F) * F(samples.unit) / np.maximum(count, F(1))
        share = count / np.maximum(visits.astype(F) + count, F(1))
        step = np.minimum(share * (F(4) + share * (F(-6) + share * (F(4) - share))), F(1))
        return self.weights(np.where(counts > 0, known + step * (mean - known), known), visits + counts)

    def weights(self, radiance, visits):
        """Unnormalized probabilities: each cell with the visit-weighted mean of its 3 x 3 neighborhood as prior."""
        volumes, cells = radiance.shape
        side = int(round(cells**0.5))
        shape = (volumes, side, side)
        visited = visits > 0
        number = in_order(in_order(visited.reshape(shape).astype(F), 2), 1)
        light = in_order(in_order(np.where(visited, radiance, F(0)).reshape(shape), 2), 1)
        volume_mean = np.where(number > 0, light / np.maximum(number, F(1)), F(0))[:, None, None]

        weight = np.minimum(visits, 1000000).astype(F).reshape(shape)
        weighed = weight * radiance.reshape(shape)
        weight_sum, weighed_sum = self.neighborhood(weight), self.neighborhood(weighed)
        total = self.PRIOR * volume_mean
        total_weight = np.full(shape, self.PRIOR)
        for shift in (0, 1, 2):
            total = total + weighed_sum[:, :, shift : shift + side]
            total_weight = total_weight + weight_sum[:, :, shift : shift + side]
        smooth = (weighed + self.PRIOR * (total / total_weight)) / (weight + self.PRIOR)
        return smooth.reshape(volumes, cells)

    def neighborhood(self, values):
        """Sums of each row with its neighbors, by column, between two empty columns."""
        volumes, side, _ = values.shape
        padded = np.zeros((volumes, side + 2, side + 2), F)
        padded[:, 1:-1, 1:-1] = values
        return padded[:, :-2] + padded[:, 1:-1] + padded[:, 2:]
