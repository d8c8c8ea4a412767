"""Pictures of what is learned, by matplotlib."""

import numpy as np

PIXELS = 160


# Field.plot()
def plot_hemisphere(field, volume, values="radiance", axes=None, brightest=None):
    import matplotlib.pyplot as plt

    normal, directions = field.normals[volume], field.directions[volume]
    right = np.cross([0, 0, 1] if abs(normal[2]) < 0.9 else [1, 0, 0], normal)
    right /= np.linalg.norm(right)
    x, y = np.meshgrid(*2 * [(np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1])
    height = 1 - x * x - y * y
    seen = (
        x[..., None] * right - y[..., None] * np.cross(normal, right) + np.sqrt(np.maximum(height, 0))[..., None] * normal
    )
    nearest = (seen @ directions.T).argmax(axis=2)
    disc = np.where(height > 0, getattr(field, values)[volume][nearest], np.nan)
    axes = axes or plt.subplots(figsize=(3, 3))[1]
    axes.imshow(disc, cmap="inferno", vmin=0, vmax=brightest, interpolation="nearest")
    axes.axis("off")
    return axes
