# SPDX-License-Identifier: MIT
"""The table of machines is the bench's."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench/targets"))
