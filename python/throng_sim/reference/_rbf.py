"""Vector fields through anchors: Jin, Xu, Wang, Huang, Zhang, Interactive control of large-crowd navigation in virtual
environments using vector fields, IEEE CG&A 28(6), 2008. Kernels: docs/fields.md.

The field is a sum of radial functions round the anchors, plus a linear part for thin plates:
f(x) = sum_j d_j phi(|x - c_j|) + p_0 + p_1 x + p_2 y. The weights solve

    [ Phi + smoothing I   P ] [d]   [velocities]
    [ P^T                 0 ] [p] = [0]            with rows (1, x, y) of P.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ._vectors import Array, Floats, length


def thin_plate(r: Floats) -> Array:
    """Returns r^2 log r; 0 at 0.

    >>> thin_plate([0.0, 1.0, np.e]).round(3)
    array([0.   , 0.   , 7.389])
    """
    r = np.asarray(r, float)
    return np.where(r > 0, r**2 * np.log(np.where(r > 0, r, 1.0)), 0.0)


def wendland(r: Floats, reach: float) -> Array:
    """Returns Wendland's (1 - r)^4 (4 r + 1), with r in parts of `reach`; 0 beyond it.

    >>> wendland([0.0, 1.0, 2.0], reach=2.0)
    array([1.    , 0.1875, 0.    ])
    """
    part = np.asarray(r, float) / reach
    return np.maximum(1 - part, 0.0) ** 4 * (4 * part + 1)


def rbf(
    anchors: Floats, velocities: Floats, *, reach: float | None = None, smoothing: float = 0.0
) -> Callable[[Floats], Array]:
    """Returns the field with these velocities, (k, 2), at the anchors, (k, 2): a function of places, (m, 2).

    Thin plates; with `reach`, in metres, Wendland's kernel, so that an anchor has influence only within it. With
    `smoothing` above 0 the field only approximates the velocities.

    >>> field = rbf([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> field([[0.0, 1.0], [0.0, 0.5]]).round(3) + 0.0
    array([[0. , 1. ],
           [0.5, 0.5]])
    """
    places, given = np.asarray(anchors, float), np.asarray(velocities, float)
    if places.shape != given.shape or places.ndim != 2 or places.shape[1] != 2:
        raise ValueError(f"anchors {places.shape} and velocities {given.shape} must both have the shape (k, 2)")
    # anchors within 1 of the origin: better numbers, the same field
    middle = places.mean(axis=0)
    extent = float(length(places - middle).max()) or 1.0
    centers = (places - middle) / extent

    def influence(at: Array) -> Array:
        r = np.linalg.norm(at[:, None] - centers, axis=-1)
        return thin_plate(r) if reach is None else wendland(r, reach / extent)

    def linear(at: Array) -> Array:
        return np.column_stack([np.ones(len(at)), at]) if reach is None else np.empty((len(at), 0))

    p = linear(centers)
    terms = p.shape[1]
    system = np.block([[influence(centers) + smoothing * np.eye(len(centers)), p], [p.T, np.zeros((terms, terms))]])
    # least squares: anchors on one line leave the slope across it open, which is then 0
    weights = np.linalg.lstsq(system, np.concatenate([given, np.zeros((terms, 2))]))[0]

    def field(at: Floats) -> Array:
        x = (np.asarray(at, float).reshape(-1, 2) - middle) / extent
        return np.asarray(np.column_stack([influence(x), linear(x)]) @ weights)

    return field
