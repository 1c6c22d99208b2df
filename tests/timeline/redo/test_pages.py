import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vasc.timeline.redo.pages import PAGE, Pages

OFFSETS = st.integers(0, 3 * PAGE)
WRITES = st.tuples(OFFSETS, st.integers(1, 2 * PAGE + 5), st.integers(1, 255))


@pytest.fixture(scope="module")
def below(tmp_path_factory):
    path = tmp_path_factory.mktemp("pages") / "file"
    path.write_bytes(bytes(i % 251 for i in range(PAGE + 1234)))
    handle = os.open(path, os.O_RDONLY)
    yield handle, path.read_bytes()
    os.close(handle)


@given(
    steps=st.lists(st.one_of(WRITES, OFFSETS), max_size=8),
    reads=st.lists(st.tuples(OFFSETS, OFFSETS)),
)
def test_pages_hold_what_a_list_of_bytes_would(below, steps, reads):
    handle, content = below
    pages, plain = Pages(handle), bytearray(content)
    for step in steps:
        if isinstance(step, int):
            # HDF5 never reads what it has not written; lengths are what counts
            pages.truncate(max(step, pages.size))
            plain.extend(bytes(max(0, step - len(plain))))
            continue
        offset, length, value = step
        pages.write(offset, bytes([value]) * length)
        plain.extend(bytes(max(0, offset + length - len(plain))))
        plain[offset : offset + length] = bytes([value]) * length
    assert pages.size == len(plain)
    for offset, length in reads:
        target = bytearray(length)
        n_bytes = pages.read_into(offset, memoryview(target))
        assert target[:n_bytes] == plain[offset : offset + length]


def test_what_is_cut_off_is_zero_when_the_file_grows_again(below):
    handle, content = below
    pages = Pages(handle)
    pages.truncate(100)
    pages.write(200, b"new")
    target = bytearray(203)
    assert pages.read_into(0, memoryview(target)) == 203
    assert target == content[:100] + bytes(100) + b"new"


def test_beyond_the_end_nothing_is_read(below):
    pages = Pages(below[0])
    assert pages.read_into(pages.size, memoryview(bytearray(5))) == 0
