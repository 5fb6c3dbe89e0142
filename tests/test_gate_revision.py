"""What `gate --against` takes from another revision is that revision's, and the repository is left as it is."""

from pathlib import Path

import pytest

from harness.contract import FirsthitError
from harness.gate import revision

from .test_gate_against import CONFIG, KERNEL, METHOD, device_of, git

pytestmark = pytest.mark.usefixtures("devices_found_once")
CELLS = 2


def add_method(folder, name):
    folder.mkdir(parents=True)
    (folder / "method.py").write_text(METHOD.replace('"mine"', f'"{name}"'))
    (folder / "kernel.glsl").write_text(KERNEL)


@pytest.fixture
def top(tmp_path):
    """A repository of one method and its config, committed."""
    made = tmp_path / "repository"
    add_method(made / "plugins" / "mine", "mine")
    (made / "plugin.toml").write_text(CONFIG.format(device=device_of("opengl:", "opencl:")))
    git(tmp_path, "init", "-q", "repository")
    commit(made)
    return made


def commit(top):
    git(top, "add", "-A")
    git(top, "commit", "-q", "-m", "more")


def cells(top):
    """Return what HEAD makes of the config."""
    device = device_of("opengl:", "opencl:")
    return revision.programs_at(revision.found("HEAD", top / "plugins"), top / "plugin.toml", [device]).cells


@pytest.mark.parametrize("name", ["", "--foo", "^HEAD", "HEAD..HEAD", "HEAD:plugins", "HEAD^{tree}"])
def test_what_is_no_commit_is_told_as_such(top, name):
    reasons = {"": "the name of the revision is empty", "HEAD:": "is a tree of", "HEAD^": "is a tree of"}
    with pytest.raises(FirsthitError) as raised:
        revision.found(name, top / "plugins")
    assert reasons.get(name[:5], f"has no revision {name!r}") in str(raised.value)


@pytest.mark.parametrize("worktree", [False, True])
def test_within_a_hook_the_commit_that_git_is_making_is_left_alone(top, tmp_path, monkeypatch, worktree):
    """There git names its own index and, in a worktree, its own repository, wherever git is called."""
    if worktree:
        git(top, "worktree", "add", "-q", "--detach", str(tmp_path / "beside"))
        top = tmp_path / "beside"
    (top / "staged").write_text("by the user\n")
    git(top, "add", "staged")
    made = Path(git(top, "rev-parse", "--absolute-git-dir"))
    before = (made / "index").read_bytes()
    monkeypatch.setenv("GIT_INDEX_FILE", str(made / "index"))
    if worktree:
        monkeypatch.setenv("GIT_DIR", str(made))
    assert len(cells(top)) == CELLS
    assert (made / "index").read_bytes() == before


def test_nothing_is_written_into_the_repository(top):
    """So it may be read-only, several gates may run at once, and none that is stopped leaves anything there."""

    def held():
        return {path: path.stat().st_mtime_ns for path in (top / ".git").rglob("*")}

    (top / ".git" / "hooks").mkdir(exist_ok=True)
    for name in ("post-checkout", "post-index-change", "reference-transaction"):
        hook = top / ".git" / "hooks" / name
        hook.write_text("#!/bin/sh\ntouch hook-ran\n")
        hook.chmod(0o755)
    before = held()
    assert len(cells(top)) == CELLS
    assert held() == before
    assert not list(top.rglob("hook-ran"))


def test_methods_may_print_and_a_mistake_fails_their_cells_and_names_their_file(top):
    path = top / "plugins" / "mine" / "method.py"
    path.write_text(f"import atexit\nprint('hello')\natexit.register(print, 'bye')\n{METHOD}")
    commit(top)
    assert len(cells(top)) == CELLS
    path.write_text("raise RuntimeError('this\\nand that')")
    commit(top)
    told = "method 'mine' cannot be loaded: plugins/mine/method.py:1: RuntimeError: this\nand that"
    assert [former.failure for former in cells(top).values()] == [told] * CELLS


def test_a_link_out_of_the_revision_is_no_method_of_it(top):
    """It leads to the method as it is now, or nowhere."""
    real, link = top / "real", top / "plugins" / "mine"
    link.rename(real)
    for target in (real, Path("../../outside")):
        link.unlink(missing_ok=True)
        link.symlink_to(target)
        commit(top)
        (top.parent / "outside").mkdir(exist_ok=True)
        (top.parent / "outside" / "method.py").write_text(METHOD)
        with pytest.raises(FirsthitError, match=f"plugins/mine at HEAD is a link to {target}, out of the revision"):
            cells(top)
    link.unlink()
    link.symlink_to("../real")
    commit(top)
    assert len(cells(top)) == CELLS


def test_a_submodule_that_holds_a_method_now_is_named_and_others_do_not_matter(top):
    """A revision's files do not hold what is in a submodule, so that the method would be a new one."""
    git(top, "-c", "protocol.file.allow=always", "submodule", "--quiet", "add", str(top), "plugins/theirs")
    commit(top)
    assert len(cells(top)) == CELLS
    (top / "plugins" / "theirs" / "method.py").write_text(METHOD)
    with pytest.raises(FirsthitError, match="plugins/theirs at HEAD is a submodule; give --plugins a folder in it"):
        cells(top)
