import os
import socket

import pytest

from scene.files.files import Unreadable, checked, content

MOST = 1_000_000


def fifo(folder):
    os.mkfifo(folder / "pipe")
    return folder / "pipe"


def unix_socket(folder):
    with socket.socket(socket.AF_UNIX) as opened:
        opened.bind(str(folder / "socket"))
    return folder / "socket"


def too_large(folder):
    with (folder / "large").open("wb") as file:
        file.truncate(MOST + 1)
    return folder / "large"


def chained(folder):
    (folder / "loop").symlink_to("loop")
    return folder / "loop"


NOT_READ = {
    "a folder": (lambda folder: folder, "is a folder, and a file is needed"),
    "nothing": (lambda folder: folder / "none", "no such file"),
    "a pipe": (fifo, "is no regular file"),
    "a socket": (unix_socket, "is no regular file"),
    "a device": (lambda folder: "/dev/zero", "is no regular file"),
    "too much": (too_large, "has 1.1 MB, and at most 1 MB are read"),
    "a link to itself": (chained, "symbolic links"),
    "a zero byte": (lambda folder: "a\0b", "is a name that no file can have"),
    "no letters of a file": (lambda folder: "a\ud800b", "is a name that no file can have"),
    "a long name": (lambda folder: folder / ("a" * 5000), "name too long"),
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="of POSIX")
@pytest.mark.parametrize("read", [checked, content])
@pytest.mark.parametrize(("made", "why"), NOT_READ.values(), ids=NOT_READ)
def test_what_is_no_file_of_its_size_is_named_at_once(tmp_path, made, why, read):
    with pytest.raises(Unreadable, match=why) as found:
        read(made(tmp_path), MOST)
    assert str(found.value).isprintable()
    assert len(str(found.value)) < 500


def test_a_file_of_the_greatest_size_is_read_whole(tmp_path):
    path = tmp_path / "whole"
    path.write_bytes(held := os.urandom(MOST))
    assert checked(path, MOST) == path
    assert content(path, MOST) == held


def test_a_file_that_grows_after_it_was_checked_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "growing"
    path.write_bytes(b"four")
    fstat = os.fstat

    def growing(handle):
        status = fstat(handle)
        with path.open("ab") as file:
            file.write(bytes(MOST))
        return status

    monkeypatch.setattr(os, "fstat", growing)
    with pytest.raises(Unreadable, match="at most 1 MB"):
        content(path, MOST)


def test_a_file_swapped_for_a_pipe_after_it_was_checked_is_refused(tmp_path, monkeypatch):
    path, opened = tmp_path / "file", os.open
    path.write_bytes(b"four")

    def swapped(given, flags, **options):
        path.unlink()
        os.mkfifo(path)
        return opened(given, flags, **options)

    monkeypatch.setattr(os, "open", swapped)
    with pytest.raises(Unreadable, match="is no regular file"):
        content(path, MOST)


def test_a_file_that_has_nothing_to_give_now_is_as_it_was_found(tmp_path, monkeypatch):
    opened = open

    class Waiting:
        def __init__(self, handle, _):
            self.file = opened(handle, "rb")

        def __enter__(self):
            return self

        def __exit__(self, *_):
            self.file.close()

        def read(self, size):
            return self.file.read(size) or None

    (tmp_path / "log").write_bytes(b"held")
    monkeypatch.setattr("builtins.open", Waiting)
    assert content(tmp_path / "log", MOST) == b"held"
