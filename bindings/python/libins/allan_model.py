"""Noise of a sensor as independent terms: what each adds to the Allan variance, and how sure an estimate of it is.

A term is known by the covariance of what the sensor's output integrates to (the angle of a gyro) between instants t
apart, up to parts that second differences remove: C(t). With D_m(i) = theta(i + 2m) - 2 theta(i + m) + theta(i) follow
    avar(m dt)            = E[D_m^2] / (2 (m dt)^2)
    cov(avar(a), avar(b)) = 2 sum over i, j of E[D_a(i) D_b(j)]^2 / (2 a^2 2 b^2 dt^4 M_a M_b), of a Gaussian process
Units: SI and s. Sources: IEEE Std 952-1997, annex C (the terms); C. A. Greenhall, Recipes for degrees of freedom of
frequency stability estimators, IEEE Trans. Instrum. Meas. 40(6), 1991, 994-999 (variances of overlapping estimates).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Kernel = Callable[[Array], Array]

LAGS = 4
"""Points of the sum over lags in one cluster of the shorter of two."""
FAR = 32
"""Ratio of two clusters beyond which only quantisation correlates their variances."""
DIFFERENCE = ((-1, 1.0), (0, -2.0), (1, 1.0))


@dataclass(frozen=True)
class Term:
    """One term for a coefficient of 1; a ramp is no noise and has no kernel."""

    name: str
    kernel: Kernel | None

    def avar(self, tau: Array) -> Array:
        """Allan variance at cluster times [s]."""
        if self.kernel is None:
            return tau**2 / 2
        zero = self.kernel(np.zeros(1))[0]
        return np.asarray((6 * zero - 8 * self.kernel(tau) + 2 * self.kernel(2 * tau)) / (2 * tau**2))


def _flicker(t: Array) -> Array:
    return t**2 * np.log(np.where(t > 0, t, 1.0)) / (2 * np.pi)


QUANTISATION = Term("quantisation", lambda t: (t == 0).astype(float))
RANDOM_WALK = Term("random_walk", lambda t: -t / 2)
BIAS_INSTABILITY = Term("bias_instability", _flicker)
RATE_RANDOM_WALK = Term("rate_random_walk", lambda t: t**3 / 12)
RATE_RAMP = Term("rate_ramp", None)
TERMS = (QUANTISATION, RANDOM_WALK, BIAS_INSTABILITY, RATE_RANDOM_WALK, RATE_RAMP)


def filtered(lag_s: float) -> Term:
    """Random walk whose samples have passed a first-order low pass of that time constant; 0: none."""
    if lag_s == 0:
        return RANDOM_WALK

    def kernel(t: Array) -> Array:
        x = t / lag_s
        return -lag_s / 2 * (x + np.expm1(-x))

    return Term("random_walk", kernel)


def markov(tau_s: float) -> Term:
    """First-order Gauss-Markov process of correlation time tau_s; its coefficient is its standard deviation."""

    def kernel(t: Array) -> Array:
        x = t / tau_s
        return -(tau_s**2) * (x + np.expm1(-x))

    return Term("markov", kernel)


@dataclass(frozen=True)
class Clusters:
    """Which averages are taken: m samples of dt each, from stretches of samples that are not joined."""

    dt: float
    m: tuple[int, ...]
    lengths: tuple[int, ...]

    @property
    def tau(self) -> Array:
        """Cluster times [s]."""
        return np.array(self.m) * self.dt

    def counts(self, length: int) -> NDArray[np.int64]:
        """Second differences in a stretch of so many samples, for every m."""
        return np.asarray(np.maximum(length + 1 - 2 * np.array(self.m), 0))


def _products(kernels: Sequence[Kernel | None], clusters: Clusters, a: int, b: int) -> Array:
    """Sum over all pairs (i, j) of what each two terms make of E[D_a(i) D_b(j)], multiplied; a <= b."""
    ma, mb = clusters.m[a], clusters.m[b]
    weights = np.array([cp * cq for _, cp in DIFFERENCE for _, cq in DIFFERENCE])
    shifts = np.array([p * ma - q * mb for p, _ in DIFFERENCE for q, _ in DIFFERENCE])

    def expectations(lag: NDArray[np.int64]) -> Array:
        at = np.abs(lag + shifts[:, None]) * clusters.dt
        return np.array([weights @ kernel(at) if kernel else np.zeros(len(lag)) for kernel in kernels])

    def pairs(lag: NDArray[np.int64]) -> Array:
        total = np.zeros(len(lag))
        between = lag + mb - ma  # i - j, where the centres are `lag` apart
        for length in clusters.lengths:
            na, nb = clusters.counts(length)[[a, b]]
            total += np.maximum(np.minimum(na, nb + between) - np.maximum(0, between), 0)
        return total

    spikes = [kernel is QUANTISATION.kernel for kernel in kernels]
    at = np.unique(shifts)  # lags at which quantisation is not zero; a stride passes over them
    there = expectations(at)
    total = np.zeros((len(kernels), len(kernels)))
    if mb <= FAR * ma:
        stride = max(1, ma // LAGS)
        reach = 2 * (ma + mb) // stride
        grid = np.arange(-reach, reach + 1) * stride
        smooth = expectations(grid)
        total = stride * (smooth * pairs(grid)) @ smooth.T
    exact = (there * pairs(at)) @ there.T
    return np.where(np.logical_or.outer(spikes, spikes), exact, total)


def products(terms: Sequence[Term], clusters: Clusters) -> Array:
    """[a, b, i, j]: its sum with p_i p_j is the covariance of the Allan variances; p: squared coefficients."""
    size = len(clusters.m)
    counts = np.sum([clusters.counts(length) for length in clusters.lengths], axis=0)
    kernels = [term.kernel for term in terms]
    out = np.zeros((size, size, len(terms), len(terms)))
    for a in range(size):
        for b in range(a, size):
            scale = (2 * clusters.tau[a] ** 2) * (2 * clusters.tau[b] ** 2) * counts[a] * counts[b]
            out[a, b] = out[b, a] = 2 / scale * _products(kernels, clusters, a, b)
    return out


def covariance(of_terms: Array, squares: Array) -> Array:
    """Of the estimated Allan variances; of_terms: products()."""
    return np.asarray(np.einsum("abij,i,j->ab", of_terms, squares, squares))
