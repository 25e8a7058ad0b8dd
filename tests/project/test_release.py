"""A release has one version: that of metadata.txt, the changelog and the tag."""

import shutil
import subprocess

import pytest
import release

if not shutil.which("git"):
    pytest.skip("there is no git", allow_module_level=True)


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """Return a function that commits files, with a tag, where `make release` looks for them."""
    monkeypatch.setattr(release, "ROOT", tmp_path)

    def git(*words):
        who = ("-c", "user.name=A", "-c", "user.email=a@example.org")
        subprocess.run(["git", "-C", tmp_path, *who, *words], check=True, capture_output=True)

    def commit(heading, tag=None):
        git("init", "--quiet")
        (tmp_path / "metadata.txt").write_text("[general]\nversion=1.2.3\n")
        (tmp_path / "CHANGELOG.md").write_text(f"# Changelog\n\n## {heading}\n")
        git("add", "--all")
        git("commit", "--quiet", "--message", "A release")
        if tag:
            git("tag", tag)

    return commit


@pytest.mark.parametrize("tag", [None, "v1.2.3", "draft"])
def test_the_version_is_that_of_changelog_and_tag(repository, tag):
    repository("1.2.3 - 2026-01-31", tag)
    assert release.check_version() == "1.2.3"


@pytest.mark.parametrize(
    "heading, tag, problem",
    [
        ("1.2.2 - 2026-01-31", None, "no heading '## 1.2.3 - YYYY-MM-DD'"),
        ("1.2.3", "v1.2.3", "no heading '## 1.2.3 - YYYY-MM-DD'"),
        ("1.2.3 - 2026-01-31", "v1.3.0", "version 1.2.3, the tag is v1.3.0"),
    ],
)
def test_another_version_is_refused(repository, heading, tag, problem):
    repository(heading, tag)
    with pytest.raises(SystemExit, match=problem):
        release.check_version()
