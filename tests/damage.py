"""Files as hands, disks and strangers spoil them: content changed here and there, bytes that are no text.

What is drawn follows from FUZZ_SEED, a whole number: the same one draws the same files, another one others. As
many are drawn of each kind as FUZZ_TRIES says.
"""

import json
import os
import resource
import signal
import unicodedata
from contextlib import contextmanager
from copy import deepcopy

from hypothesis import HealthCheck, Phase, given, note, seed, settings
from hypothesis import strategies as st

SEED = int(os.environ.get("FUZZ_SEED", "21"))
TRIES = int(os.environ.get("FUZZ_TRIES", "1000"))
MOST = 4  # changes in a file
LINES, LETTERS = 52, 600  # of a message, and of each line besides the name of its file
HANGS, MEMORY, AREA = 20, 8 * 2**30, resource.RLIMIT_AS  # s, bytes, of what


class Raw(str):
    """TOML as it stands, quotes and all."""


LONG = "x" * 5000
FLOATS = "0.5 5e-324 1e-310 1e-206 1e-150 1e-30 1e-12 1e12 1e30 1e100 1e154 1e194 1e300 1.7e308 inf -inf nan -0.0"
NUMBERS = [0, -1, 1, 2, 64, 10**9, 10**30, 2**63, -(2**70), *map(float, FLOATS.split())]
NUMBERS += map(Raw, ("1e999", "9" * 5000, "0x" + "f" * 400, "1_0", "1979-05-27T07:32:00Z", "07:32:00"))
MEASURES = (
    "5 mm|-1 N|0 s|1e400 m|nan m|inf Pa|5 furlong|25 degC|1 dB|m|1e3|1 mm/mm|100 %|1e-320 m|٣ mm|1 mm²|1 m/0"
)
POWERS = "1 m**99999|9**9**9**9 m|((((((1 m|1 {m}|1e9**1e9 m|1 m ** -1e9|1 __import__('os')"
QUANTITIES = [*MEASURES.split("|"), *POWERS.split("|"), "1 m\n1 m", "1 " + "k" * 50 + "m", "1" * 400 + " m"]
NAMES = "|a|type|sphere|kelvin|slide|self-affine|program|../..|/dev/zero|/dev/null|.|quick-start|none|true"
WORDS = [*NAMES.split("|"), LONG, "\u202eabc", "\x00", "\x1b[31mred\x1b[0m\x07", "\x9b2J", "\ud800", "😀" * 300]
TABLES = ([], {}, [[]], [{}], [1, "a", None], {"type": "sphere"}, {"": {"": 1}}, [1.0] * 3000, True, False)
NASTY = (NUMBERS, QUANTITIES, WORDS, TABLES)
SIGNS = b"[ ] [[ ]] { } = , ; . # ' \" ''' \\ nan -inf 1e999 1,2,3 -- type=1 [[series]]"
STRAY = b"\n|\r|\t|\0|\xff\xfe|\x1b[2J|\xef\xbb\xbf|\xc2\x9b"
TOKENS = [
    *SIGNS.split(),
    *STRAY.split(b"|"),
    b"[" * 2000,
    b"9" * 5000,
    b"x = {a = " * 300,
    b"[" + b"a." * 600 + b"a]\n",
]


def toml(value):
    """A value as TOML, tables in one line; what it has no words for is left for the reader to refuse."""
    if isinstance(value, Raw):
        return str(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml(str(name))} = {toml(each)}" for name, each in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return str(value).lower() if isinstance(value, bool | float) else str(value)


def as_toml(content):
    """The bytes of a file, a line a table."""
    return "\n".join(f"{toml(name)} = {toml(value)}" for name, value in content.items()).encode("utf-8", "replace")


def places(content):
    """Every place of a tree, as what holds it and its name or number there."""
    named = (
        content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
    )
    for name, value in named:
        yield content, name
        yield from places(value)


def _changed(content, random, others):
    """One change, in place."""
    found = list(places(content))
    if not found:
        return
    inside, name = random.choice(found)
    value, other = inside[name], random.choice(list(places(random.choice(others))))
    match random.choice(("drop", "rename", "nasty", "nasty", "scale", "nest", "graft")):
        case "drop":
            del inside[name]
        case "rename" if isinstance(inside, dict):
            at = random.randrange(len(name) or 1)
            other_name = random.choice(
                (name[:at] + name[at + 1 :], name + "s", name.upper(), random.choice(WORDS))
            )
            inside[other_name] = inside.pop(name)
        case "scale" if isinstance(value, int | float):
            inside[name] = value * 10.0 ** random.randint(-40, 40)
        case "nest":
            for _ in range(random.choice((1, 1, 2, 60))):
                value = random.choice(([value], {random.choice(WORDS): value}))
            inside[name] = value
        case "graft":
            inside[name] = deepcopy(other[0][other[1]])
        case _:
            inside[name] = deepcopy(random.choice(random.choice(NASTY)))


@st.composite
def trees(draw, contents):
    """The content of a file, changed in some places."""
    random = draw(st.randoms(use_true_random=False))
    content = deepcopy(random.choice(contents))
    for _ in range(random.randint(1, MOST)):
        _changed(content, random, contents)
    return content


@st.composite
def spoilt(draw, files):
    """The bytes of a file, changed in some places."""
    random = draw(st.randoms(use_true_random=False))
    content = bytearray(random.choice(files))
    for _ in range(random.randint(1, MOST)):
        start = random.randint(0, len(content))
        stop = min(start + random.choice((0, 1, 1, 8, 60, len(content))), len(content))
        match random.choice(("cut", "random", "token", "token", "twice", "bit")):
            case "cut":
                del content[start:stop]
            case "random":
                content[start:stop] = bytes(random.randrange(256) for _ in range(min(stop - start, 60)))
            case "token":
                content[start:stop] = random.choice(TOKENS)
            case "twice":
                content[start:start] = content[start:stop] * random.choice((1, 2, 40))
            case "bit" if start < len(content):
                content[start] ^= 1 << random.randrange(8)
    return bytes(content)


def fuzz(law, *strategies, tries=TRIES):
    """Check a law on `tries` files; a counterexample is printed with the seed and made as small as possible."""

    @seed(SEED)
    @settings(
        max_examples=tries,
        deadline=None,
        database=None,
        print_blob=True,
        phases=(Phase.generate, Phase.shrink),
        suppress_health_check=(HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example),
    )
    @given(st.tuples(*strategies))
    def held(drawn):
        note(f"FUZZ_SEED={SEED}")
        law(*drawn)

    held()


@contextmanager
def bounded():
    """Time and memory that reading and small solves may take: far more than any of them takes.

    Time of the processor, as machines are busy; and six times as much by the clock, of what waits for ever.
    """

    def hangs(signum, frame):
        raise AssertionError(f"hangs: more than {HANGS} s of processor, or {6 * HANGS} s")

    timers = {signal.ITIMER_PROF: (signal.SIGPROF, HANGS), signal.ITIMER_REAL: (signal.SIGALRM, 6 * HANGS)}
    before, limits = {each: signal.signal(each, hangs) for each, _ in timers.values()}, resource.getrlimit(AREA)
    for timer, (_, most) in timers.items():
        signal.setitimer(timer, most)
    resource.setrlimit(AREA, (MEMORY, limits[1]))
    try:
        yield
    finally:
        for timer, (number, _) in timers.items():
            signal.setitimer(timer, 0)
            signal.signal(number, before[number])
        resource.setrlimit(AREA, limits)


def unshowable(message, path="", letters=LETTERS):
    """Why a terminal cannot show a message, or nobody can use it; a message about a file has to name the file."""
    lines = message.split("\n")
    longest = max(len(line.replace(str(path), "")) for line in lines)
    strange = {each for each in message if unicodedata.category(each) in ("Cc", "Cf", "Cs") and each != "\n"}
    wrong = {
        f"{len(lines)} lines": len(lines) > LINES,
        f"a line of {longest} letters": longest > letters,
        f"control characters {strange}": strange,
        "it does not name its file": str(path) not in message,
        "it is empty": not message.strip(),
    }
    return ", ".join(why for why, holds in wrong.items() if holds)
