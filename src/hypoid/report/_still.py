"""A still picture of the pair in mesh, for print and for browsers without WebGL."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb

from ._scene import Scene

Array = np.ndarray[Any, Any]
EYE = (0.55, 0.6, -1.0)  # from where the picture is seen: the wheel's tooth side
UP = (0.0, 1.0, 0.0)
LIGHTS = (((0.3, 0.9, 0.8), 0.62), ((-0.8, 0.2, 0.6), 0.25))  # in the viewer's frame, with strength


def draw_still(axes: Axes, shown: Scene, eye: tuple[float, float, float] = EYE) -> None:
    """Draw the scene by painting its triangles from back to front, each in its own shade."""
    view = _viewer(eye)
    corners: list[Array] = []
    colours: list[Array] = []
    for mesh in shown.meshes:
        seen = mesh.vertices @ view.T
        faces = seen[mesh.triangles]
        normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        size = np.linalg.norm(normal, axis=1)
        normal /= np.where(size > 0.0, size, 1.0)[:, None]
        front = normal[:, 2] > 0.0
        shade = 0.34 + sum(
            strength * np.clip(normal @ (np.array(light) / np.linalg.norm(light)), 0.0, 1.0)
            for light, strength in LIGHTS
        )
        rgb = np.clip(np.outer(shade, to_rgb(mesh.colour)), 0.0, 1.0)
        corners.append(faces[front])
        colours.append(rgb[front])
    faces, rgb = np.concatenate(corners), np.concatenate(colours)
    order = faces[:, :, 2].mean(axis=1).argsort()
    polygons = PolyCollection(
        list(faces[order][:, :, :2]),
        facecolors=rgb[order],
        edgecolors=rgb[order],
        linewidths=0.2,
        rasterized=True,
    )
    axes.add_collection(polygons)
    low, high = faces[:, :, :2].min(axis=(0, 1)), faces[:, :, :2].max(axis=(0, 1))
    axes.set_xlim(low[0] - 2.0, high[0] + 2.0)
    axes.set_ylim(low[1] - 2.0, high[1] + 2.0)
    axes.set_aspect("equal")
    axes.axis("off")


def _viewer(eye: tuple[float, float, float]) -> Array:
    """Rows: right, up and towards the viewer."""
    towards = np.array(eye) / np.linalg.norm(eye)
    right = np.cross(UP, towards)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(towards, right), towards])
