"""Overlapping Allan deviation of a sensor at rest, and the noise coefficients that it shows, each with its confidence.

    curve = deviation([rate], dt)           # stretches of samples at rest, SI
    fit = coefficients(curve)               # fit["random_walk"].value: angle random walk [rad/sqrt(s)] of a gyro

sigma^2(tau) = 3 Q^2/tau^2 + N^2/tau + (2 ln 2/pi) B^2 + K^2 tau/3 + R^2 tau^2/2 (IEEE Std 952-1997, annex C), by least
squares weighted with the variance of each point under the fitted model; no coefficient is negative. The 95 % intervals
are those of the fit without that limit, of all terms together; they count that neighbouring points share their samples.
A term is seen when its interval does not reach 0.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from libins.allan_model import QUANTISATION, RANDOM_WALK, TERMS, Clusters, Term, covariance, filtered, markov, products
from libins.errors import UsageError

Array = NDArray[np.float64]

PER_DECADE = 12
LEAST_SAMPLES = 30
Z95 = 1.959964
Z68 = 0.994458
"""Of the error bars: 68 % lie within."""
LEAST_CUBE_ROOT = 0.1
"""Of a chi-square quantile over its degrees of freedom, so that a bar ends somewhere."""
MODEL_ERROR = 0.02
"""Of a variance: no point counts as surer than that, for no sensor is exactly the sum of these terms."""
LAG_SEEN = 50.0
"""Drop of the weighted squares for which samples are taken as filtered."""
FINER = 19
"""Points between two of the first grid for the low pass."""
STEPS = 4
"""Towards the upper end of an interval."""
PASSES = 4
"""Of the fit, each with the weights of the model before."""


@dataclass(frozen=True)
class Curve:
    """Allan variance at each cluster time, and what it was taken from."""

    clusters: Clusters
    avar: Array

    @property
    def tau(self) -> Array:
        """Cluster times [s]."""
        return self.clusters.tau

    @property
    def adev(self) -> Array:
        """Allan deviation, in the unit of the samples."""
        return np.sqrt(self.avar)


@dataclass(frozen=True)
class Coefficient:
    """A coefficient and its 95 % interval."""

    value: float
    low: float
    high: float

    @property
    def seen(self) -> bool:
        """The record shows the term."""
        return self.low > 0


@dataclass(frozen=True)
class Fit:
    """Coefficients by term; `model` is the deviation that they make, `bars` the 68 % interval of each point."""

    coefficients: dict[str, Coefficient]
    model: Array
    bars: tuple[Array, Array]
    lag_s: float
    """Time constant of the low pass that the samples have passed; 0: none is seen."""
    misfit: Array
    """Variance less the model's, in standard deviations of the point."""
    weights: Array
    """Variance that each point was taken with."""

    def __getitem__(self, name: str) -> Coefficient:
        """Coefficient of a term."""
        return self.coefficients[name]


@dataclass(frozen=True)
class Markov:
    """Curves as random walk and a bias that is a first-order Gauss-Markov process, as a filter models them."""

    random_walk: tuple[float, ...]
    sigma: tuple[float, ...]
    tau_s: float
    at_limit: bool
    """The correlation time is the longest that the record could show: the bias still wanders at its end."""


def _decades(low: float, high: float) -> Array:
    """Both ends, and what lies between on a logarithmic grid."""
    first, last = math.log10(low), math.log10(high)
    return np.logspace(first, last, int(PER_DECADE * (last - first)) + 2)


def deviation(stretches: Sequence[Array], dt: float, tau_min_s: float = 0.0, tau_max_s: float = math.inf) -> Curve:
    """Overlapping Allan variance over all stretches; none is joined to the next. Raises UsageError."""
    longest = max((len(x) for x in stretches), default=0)
    if longest < LEAST_SAMPLES:
        raise UsageError(f"{longest} samples in a row at rest: at least {LEAST_SAMPLES} are needed")
    m = np.unique(np.round(_decades(1, longest // 3)).astype(np.int64))
    m = m[(m * dt >= tau_min_s * (1 - 1e-9)) & (m * dt <= tau_max_s * (1 + 1e-9))]
    if len(m) < len(TERMS):
        raise UsageError(
            f"cluster times {tau_min_s:g} .. {tau_max_s:g} s hold {len(m)} points of this record "
            f"({dt:g} .. {longest // 3 * dt:g} s): at least {len(TERMS)} are needed; widen --tau-s"
        )
    sums, counts = np.zeros(len(m)), np.zeros(len(m))
    for x in stretches:
        theta = np.concatenate([[0.0], np.cumsum(x - np.mean(x))]) * dt
        for i, n in enumerate(m):
            if len(x) + 1 > 2 * n:
                d = theta[2 * n :] - 2 * theta[n:-n] + theta[: -2 * n]
                sums[i] += d @ d
                counts[i] += len(d)
    avar = sums / (2 * (m * dt) ** 2 * counts)
    if not np.all(avar > 0):
        raise UsageError("the samples are constant: no noise is seen; check the column")
    return Curve(Clusters(dt, tuple(m.tolist()), tuple(len(x) for x in stretches)), avar)


def _squares(columns: Array, curve: Curve, variance: Array) -> Array:
    """Squared coefficients, none negative: the best of all subsets of columns."""
    root = np.sqrt(variance)
    best, least = np.zeros(columns.shape[1]), math.inf
    for size in range(1, columns.shape[1] + 1):
        for chosen in map(list, itertools.combinations(range(columns.shape[1]), size)):
            scale = 1 / np.linalg.norm(columns[:, chosen] / root[:, None], axis=0)
            found = np.linalg.lstsq(columns[:, chosen] * scale / root[:, None], curve.avar / root)[0] * scale
            misfit = float(np.sum(((columns[:, chosen] @ found - curve.avar) / root) ** 2))
            if np.all(found >= 0) and misfit < least:
                best, least = np.zeros(columns.shape[1]), misfit
                best[chosen] = found
    return best


def _guess(curve: Curve) -> Array:
    """Variance of each point of the curve, before anything is known of the noise."""
    span = sum(curve.clusters.lengths) * curve.clusters.dt
    return np.asarray(curve.avar**2 * (curve.tau / span + MODEL_ERROR**2), dtype=float)


def _columns(terms: Sequence[Term], curve: Curve) -> Array:
    return np.column_stack([term.avar(curve.tau) for term in terms])


def _fitted(columns: Array, curve: Curve, of_terms: Array) -> tuple[Array, Array]:
    """Squared coefficients after PASSES, and the points' variance under them."""
    variance = _guess(curve)
    for _ in range(PASSES):
        squares = _squares(columns, curve, variance)
        variance = np.diag(covariance(of_terms, squares)) + (MODEL_ERROR * curve.avar) ** 2
    return squares, variance


def _intervals(columns: Array, squares: Array, curve: Curve, variance: Array, of_terms: Array) -> tuple[Array, Array]:
    """95 % intervals of the squared coefficients, about plain weighted least squares.

    The upper end is where chance would leave the estimate so low: with the spread that it has there.
    """
    root = np.sqrt(variance)
    scale = 1 / np.linalg.norm(columns / root[:, None], axis=0)
    gain = scale[:, None] * np.linalg.pinv(columns * scale / root[:, None]) / root
    free = gain @ curve.avar

    def spread(i: int, at: Array) -> float:
        return math.sqrt(gain[i] @ covariance(of_terms, at) @ gain[i])

    low, high = squares.copy(), squares.copy()
    for i in range(len(squares)):
        low[i] = min(free[i] - Z95 * spread(i, squares), squares[i])
        for _ in range(STEPS):
            there = np.where(np.arange(len(squares)) == i, high[i], squares)
            high[i] = max(max(free[i], 0.0) + Z95 * spread(i, there), squares[i])
    return np.maximum(low, 0), np.maximum(high, 0)


def _misfit(columns: Array, curve: Curve, variance: Array) -> float:
    return float(np.sum((columns @ _squares(columns, curve, variance) - curve.avar) ** 2 / variance))


def _terms(lag_s: float) -> list[Term]:
    return [filtered(lag_s) if term is RANDOM_WALK else term for term in TERMS]


def _lag(curve: Curve) -> float:
    """Time constant of the low pass before the samples, by the least misfit on a grid."""
    variance = _guess(curve)
    without = _misfit(_columns(TERMS, curve), curve, variance)
    if without < LAG_SEEN:
        return 0.0

    def misfit(lag_s: float) -> float:
        return _misfit(_columns(_terms(lag_s), curve), curve, variance)

    best = min(_decades(0.1 * curve.tau[0], 100 * curve.tau[0]).tolist(), key=misfit)
    best = min((best * np.linspace(0.8, 1.25, FINER)).tolist(), key=misfit)
    return float(best) if without - misfit(best) >= LAG_SEEN else 0.0


@functools.lru_cache(maxsize=8)
def _of_terms(lag_s: float, clusters: Clusters) -> Array:
    """The columns of a recording mostly have it in common."""
    return products(_terms(lag_s), clusters)


def coefficients(curve: Curve) -> Fit:
    """Every term's coefficient."""
    lag_s = _lag(curve)
    columns, of_terms = _columns(_terms(lag_s), curve), _of_terms(lag_s, curve.clusters)
    squares, variance = _fitted(columns, curve, of_terms)
    ends = np.sqrt(_intervals(columns, squares, curve, variance, of_terms))
    found = {
        term.name: Coefficient(*map(float, row))
        for term, row in zip(TERMS, zip(np.sqrt(squares), *ends, strict=True), strict=True)
    }
    model = columns @ squares
    of_points = np.diag(covariance(of_terms, squares))
    misfit = (curve.avar - model) / np.sqrt(of_points)
    return Fit(found, np.sqrt(model), _bars(curve, of_points), lag_s, misfit, variance)


def _bars(curve: Curve, variance: Array) -> tuple[Array, Array]:
    """68 % interval of each deviation: chi-square with the point's degrees of freedom (Wilson and Hilferty 1931)."""
    freedom = 2 * curve.avar**2 / variance
    third = 2 / (9 * freedom)
    high, low = (np.maximum(1 - third + z * np.sqrt(third), LEAST_CUBE_ROOT) ** 3 for z in (Z68, -Z68))
    return curve.adev / np.sqrt(high), curve.adev / np.sqrt(low)


def gauss_markov(curves: Sequence[Curve], fits: Sequence[Fit]) -> Markov:
    """Quantisation, random walk and a Gauss-Markov bias in each curve; one correlation time, the one that fits best."""
    best, least = Markov((), (), 0.0, False), math.inf
    tau = curves[0].tau
    grid = _decades(10 * max(tau[0], *(fit.lag_s for fit in fits)), 4 * tau[-1])
    for tau_s in grid:
        squares, misfit = [], 0.0
        for curve, fit in zip(curves, fits, strict=True):
            columns = _columns((QUANTISATION, filtered(fit.lag_s), markov(tau_s)), curve)
            squares.append(_squares(columns, curve, fit.weights))
            misfit += float(np.sum((columns @ squares[-1] - curve.avar) ** 2 / fit.weights))
        if misfit < least:
            least = misfit
            walks, sigmas = (tuple(math.sqrt(square[i]) for square in squares) for i in (1, 2))
            best = Markov(walks, sigmas, float(tau_s), bool(tau_s == grid[-1]))
    return best


def minimum(curve: Curve) -> tuple[float, float]:
    """Cluster time and deviation where the curve is lowest: what data sheets call bias instability."""
    at = int(np.argmin(curve.avar))
    return float(curve.tau[at]), float(curve.adev[at])
