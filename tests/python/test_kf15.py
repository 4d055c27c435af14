"""The covariance of 15 errors from Python: both forms against NumPy's dense matrices."""

import numpy as np
import pytest
from reference import both

SIGMA = np.repeat([0.02, 0.5, 10.0, 1e-4, 1e-2], 3)
SENSORS = {"arw": 1e-4, "vrw": 1e-3, "bg_sigma": 1e-4, "bg_tau": 300.0, "ba_sigma": 1e-2, "ba_tau": 200.0}
DT = 0.01


@both
@pytest.mark.parametrize("form", ["Kf15", "Kf15Ud"])
def test_both_forms_follow_the_dense_filter(ins, form):
    tolerance = 1e-12 if ins.real == np.float64 else 1e-5
    strapdown = ins.Strapdown(ins.CONING_HIST2_OPT, DT, [1, 0, 0, 0], [30, -20, 1], ins.Position([0.4, 2.0, 100.0]))
    model = ins.Kf15Model(DT, **SENSORS)
    model.set(strapdown, [0.013, -0.021, -0.098])
    filter_ = getattr(ins, form)(SIGMA.tolist())
    phi = model.Phi.astype(float)
    decay = np.diag(phi)[9:]
    q = np.r_[np.full(3, 1e-4**2 * DT), np.full(3, 1e-3**2 * DT), np.zeros(3), (1 - decay**2) * SIGMA[9:] ** 2]
    dense = np.diag(SIGMA**2)
    h = np.zeros(15)
    h[[ins.KF15_P, 1, 2]] = 1, -2, 0.5
    for _ in range(20):
        filter_.propagate(model)
        dense = phi @ dense @ phi.T + np.diag(q)
    assert filter_.update(h.tolist(), 0.0, 0.04) == 0
    gain = dense @ h / (h @ dense @ h + 0.04)
    dense -= np.outer(gain, h @ dense)
    scale = np.sqrt(np.diag(dense))
    assert np.abs((filter_.P - dense) / np.outer(scale, scale)).max() < tolerance
    assert np.abs(filter_.K - gain).max() < tolerance
    with pytest.raises(ins.GateError, match=r"Kf15\w*\.update_state.*nis"):
        filter_.update_state(ins.KF15_V, 1e3, 1.0, gate=ins.KALMAN_GATE_99)
    with pytest.raises(ins.RangeError, match="index 0 to 14"):
        filter_.update_state(15, 0.0, 1.0)
