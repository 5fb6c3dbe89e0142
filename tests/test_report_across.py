"""One kernel on several devices, side by side."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from reports.analysis import derive
from reports.parts import devices_compared
from reports.reading import load
from tests.synthetic_run import write_run


def test_each_row_is_one_variant_and_its_slowest_device_is_once_as_fast(tmp_path: Path) -> None:
    frame = derive.derive(load.load(write_run(tmp_path / "quick")).frame)
    (section,) = devices_compared.sections(SimpleNamespace(listed=frame))
    (table,) = section.details
    devices = list(dict.fromkeys(column.over for column in table.columns if column.over))
    assert len(devices) > 1
    for row in table.rows:
        cells = {device: row[3 + 3 * i : 6 + 3 * i] for i, device in enumerate(devices)}
        present = {device: values for device, values in cells.items() if values[0] is not None}
        assert len(present) > 1
        rows = frame[(frame["label"] == row[2]) & (frame["precision"] == row[1]) & frame["median_ms"].notna()]
        own = rows[rows["surface_title"] == row[0]].set_index("device")
        right = {device for device in present if (own["method"] == "null").all() or own["wrong_rays"][device] == 0}
        clocks = {np.isnan(present[device][2]) for device in right}
        by_host = {d: ms * (1 + np.nan_to_num(overhead)) for d, (ms, _, overhead) in present.items()}
        slowest = max(right, key=lambda d: (by_host if len(clocks) > 1 else rows_ms(present))[d], default="")
        for device, (ms, faster, overhead) in present.items():
            assert (faster is None) == (device not in right), "no ratio of a row with wrong rays"
            if faster is not None:
                alike = np.isnan(overhead) == np.isnan(present[slowest][2])
                expected = present[slowest][0] / ms if alike else by_host[slowest] / by_host[device]
                assert abs(faster / expected - 1) < 0.1, "of common rounds by one clock, near that of the medians"
            assert np.isnan(overhead) == (device == "opengl:llvmpipe"), "no overhead over a clock that is not believed"
        assert set(present) <= set(rows["device"])


def rows_ms(present: dict[str, Any]) -> dict[str, float]:
    return {device: values[0] for device, values in present.items()}


def test_one_device_has_nothing_to_stand_beside(tmp_path: Path) -> None:
    frame = derive.derive(load.load(write_run(tmp_path / "quick")).frame)
    assert devices_compared.sections(SimpleNamespace(listed=frame[frame["device"] == frame["device"].iloc[0]])) == []
