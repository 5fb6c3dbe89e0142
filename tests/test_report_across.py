"""One kernel on several devices, side by side."""

from __future__ import annotations

from pathlib import Path

from reports import across, derive, load
from tests.synthetic_run import write_run


def test_each_row_is_one_variant_and_its_slowest_device_is_once_as_fast(tmp_path: Path) -> None:
    frame = derive.derive(load.load(write_run(tmp_path / "quick")).frame)
    (section,) = across.sections(frame)
    (table,) = section.blocks
    devices = list(dict.fromkeys(column.over for column in table.columns if column.over))
    assert len(devices) > 1
    for row in table.rows:
        cells = {device: row[3 + 3 * i : 6 + 3 * i] for i, device in enumerate(devices)}
        present = {device: values for device, values in cells.items() if values[0] is not None}
        assert len(present) > 1
        slowest = max(ms for ms, _, _ in present.values())
        for ms, faster, _ in present.values():
            assert abs(faster - slowest / ms) < 1e-12
        rows = frame[(frame["variant"] == row[2]) & (frame["precision"] == row[1]) & frame["median_ms"].notna()]
        assert set(present) <= set(rows["device"])


def test_one_device_has_nothing_to_stand_beside(tmp_path: Path) -> None:
    frame = derive.derive(load.load(write_run(tmp_path / "quick")).frame)
    assert across.sections(frame[frame["device"] == frame["device"].iloc[0]]) == []
