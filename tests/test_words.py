"""What is said of a name that is not known is made in one place."""

import subprocess
from pathlib import Path

import pytest

from harness.contract import DeviceInfo, FirsthitError
from harness.devices.interface import device_named, working
from surfaces.words import plural, suggestion

ROOT = Path(__file__).parent.parent


@pytest.mark.parametrize(
    ("name", "more", "said"),
    [
        ("tours", {}, "did you mean 'torus'?"),
        ("zzz", {}, "known: torus, horn_torus, sphere"),
        ("tours", {"most": 3}, "did you mean torus, horn_torus?"),
        ("zzz", {"most": 3, "otherwise": "see the list"}, "see the list"),
    ],
)
def test_the_nearest_name_or_all_that_are_known(name, more, said):
    assert suggestion(name, ["torus", "horn_torus", "sphere"], **more) == said
    assert suggestion(name, []) == "known: none"


def test_no_other_module_looks_for_near_names():
    found = subprocess.run(["grep", "-rl", "difflib", "--include=*.py", "harness", "methods", "reports", "surfaces"],
                           cwd=ROOT, capture_output=True, text=True, check=False).stdout.split()  # fmt: skip
    assert found == ["surfaces/words.py"]


def test_a_device_that_is_not_here_is_answered_with_those_that_are():
    def device(name, problem=None):
        return DeviceInfo(name, "", "", "", 1, True, "wall", (), problem)

    found = [device("opencl:good"), device("opencl:bad", "its compiler fails")]
    assert device_named("opencl:good", iter(found)) is found[0]
    assert working(found) == found[:1]
    with pytest.raises(FirsthitError, match="no usable device"):
        working(found[1:])
    for name, words in (
        ("opencl:god", "there is no device 'opencl:god' here; known: opencl:good, opencl:bad; see `firsthit devices`"),
        ("opencl:bad", "device 'opencl:bad' cannot be used: its compiler fails"),
    ):
        with pytest.raises(FirsthitError) as caught:
            device_named(name, found)
        assert (str(caught.value), caught.value.exit_code) == (words, 3)


def test_a_count_and_its_noun_agree():
    assert [plural(n, "row") for n in (0, 1, 2, 1000)] == ["0 rows", "1 row", "2 rows", "1,000 rows"]
