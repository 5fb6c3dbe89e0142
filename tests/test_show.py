"""What `firsthit show` says of a surface without drawing it, and values that begin with a minus sign."""

import pytest

from harness.cli import main
from harness.recommend import telling
from surfaces import from_formula


def shown(capsys, *arguments):
    code = main(["show", *arguments])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_without_a_picture_show_says_how_a_surface_is_read_and_looks_for_no_device(capsys, monkeypatch):
    monkeypatch.setattr("harness.commands.options.usable_device", lambda *_: pytest.fail("a device was looked for"))
    code, out, err = shown(capsys, "--formula", "x² + y² = 4z − e", "--parameter", "e=1/2", "--domain", "sphere:2")
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        "read as: x^2 + y^2 - (4*z - 0.5)",
        "note: e is your parameter, not Euler's number",
        "kind: a polynomial of degree 2",
        "domain: sphere:2",
        "distance bound: none is proved or stated",
    ]


def test_without_a_picture_show_tells_a_distance_bound_and_a_domain_that_cuts(capsys):
    _, out, _ = shown(capsys, "--formula", "sqrt(x^2 + y^2 + z^2) - 1", "--domain", "box:1,1,0.5")
    assert "kind: no polynomial" in out and "distance bound: the formula itself is one" in out
    assert "its domain box:1,1,0.5 cuts the surface" in " ".join(out.split())
    _, out, _ = shown(capsys, "--surface", "torus")
    assert "distance bound: sqrt((sqrt(x^2 + y^2) - R)^2 + z^2) - r" in out


def test_a_domain_that_is_found_is_said(capsys):
    code, out, _ = shown(capsys, "--formula", "(x - 3)^2 + y^2 + z^2 - 1", "--domain", "auto")
    assert code == 0 and "domain: box:" in out and "auto" not in out


@pytest.mark.parametrize(
    ("arguments", "read"),
    [
        (("--formula", "-x^2 + 1", "--domain", "sphere:2"), "-x^2 + 1"),
        (("--formula", "-z"), "-z"),
        (("--formula", "x - 1/2", "--distance", "-(x - 1/2)", "--view", "-30,20"), "x - 0.5"),
    ],
)
def test_values_may_begin_with_a_minus_sign(capsys, arguments, read):
    code, out, _ = shown(capsys, *arguments)
    assert code == 0 and f"read as: {read}\n" in out


@pytest.mark.parametrize("next_", ["-o", "--domain"])
def test_an_option_is_no_formula(capsys, next_):
    with pytest.raises(SystemExit):
        shown(capsys, "--formula", next_, "x")
    assert "--formula: expected one argument" in capsys.readouterr().err


def test_a_config_named_without_its_suffix_is_suggested(capsys, tmp_path, monkeypatch):
    (tmp_path / "mine.toml").write_text("")
    monkeypatch.chdir(tmp_path)
    assert main(["plan", "mine"]) == 2
    assert "did you mean 'mine.toml'?" in capsys.readouterr().err


def test_sentences_do_not_quote_the_start_of_a_formula():
    assert telling.subject(from_formula("x + y")) == "x + y"
    assert telling.subject(from_formula(" + ".join(["x^2"] * 30))) == "this surface"
