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
    "a folder": (lambda folder: folder, "is no regular file"),
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
