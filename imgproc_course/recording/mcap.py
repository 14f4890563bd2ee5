"""MCAP files: whatever wrote them, and also without index or end.

The format: https://mcap.dev/spec
"""

import contextlib
import heapq
import struct
from collections import Counter
from typing import NamedTuple

from rosbags.rosbag2.storage_mcap import DECOMPRESSORS, decompress

from .channels import READ_ERRORS, Channel
from .errors import RecordingError

FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(2, 9)
STATISTICS = 11
HEAD = struct.Struct("<BQ")  # of a record: what it is, its length
CHUNK_HEAD = struct.Struct("<QQQII")  # start, end, size, CRC, length of the compression's name
MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, time of recording, time of publishing
INDEX_HEAD = struct.Struct("<HI")  # channel, bytes of its entries, of which each has 16
FOOTER_TAIL = struct.Struct("<9xQ12x8s")  # where the summary begins, the magic at the end
MAGIC = b"\x89MCAP0\r\n"


class Block(NamedTuple):
    """A chunk, or a message outside of chunks: times in ns, its place in the file, {channel: messages}."""

    start: int
    end: int
    place: int
    counts: dict[int, int]


def records(read, place, end):
    """Yields (kind, place of its data, their size) of each complete record between two places."""
    while place + HEAD.size <= end:
        kind, size = HEAD.unpack(read(place, HEAD.size))
        place += HEAD.size
        if not kind or place + size > end:
            return
        yield kind, place, size
        place += size


def unpacked(chunk):
    """The records in a chunk, checked by its size and CRC."""
    _, _, size, crc, _ = CHUNK_HEAD.unpack_from(chunk)
    (compression,) = texts(chunk, CHUNK_HEAD.size - 4, 1)
    if compression not in DECOMPRESSORS:
        remedy = "record again with a compression that rosbags knows (none, zstd, lz4)"
        raise RecordingError(f"a chunk has the compression {compression!r}; {remedy}")
    place = CHUNK_HEAD.size + len(compression)
    (packed,) = struct.unpack_from("<Q", chunk, place)
    return decompress(chunk[place + 8 : place + 8 + packed], compression, size, crc)


def texts(data, place, count):
    """Yields the texts from a place in a record on."""
    for _ in range(count):
        (length,) = struct.unpack_from("<I", data, place)
        yield bytes(data[place + 4 : place + 4 + length]).decode(errors="replace")
        place += 4 + length


class McapFile:
    """An open file: its channels and counts of messages by number, and what is wrong with it as a whole."""

    def __init__(self, path, name, stack):
        self.name, self.problem, self.missing = name, "", 0
        self.channels: dict[int, Channel] = {}
        self._schemas: dict[int, tuple[str, ...]] = {0: ("type not stated", "", "")}  # name, language, text
        self._blocks: list[Block] = []
        self._loaded: tuple[Block | None, memoryview] = None, memoryview(b"")
        self._file = stack.enter_context(path.open("rb"))
        self._size = self._file.seek(0, 2)
        self._read_contents()
        self.counts = Counter[int]()
        for block in self._blocks:
            self.counts.update(block.counts)
        times = [time for block in self._blocks if block.counts for time in (block.start, block.end)]
        self.start = min(times, default=0)
        self.seconds = (max(times, default=0) - self.start) / 1e9

    def _bytes(self, place, size):
        if place + size > self._size:
            raise EOFError("it ends early")
        self._file.seek(place)
        return self._file.read(size)

    def _read_contents(self):
        """Reads which channels there are, and where, from the records outside of chunks if they say it."""
        if self._bytes(0, len(MAGIC)) != MAGIC and not any(self._places_in_summary()):
            raise ValueError("it does not begin as an MCAP file does")
        chunks, stated, kind, end = [], None, 0, len(MAGIC)
        for kind, place, size in self._records_outside_chunks():
            end = place + size
            if kind == CHUNK:
                start, stop, *_ = CHUNK_HEAD.unpack(self._bytes(place, CHUNK_HEAD.size))
                chunks.append(Block(start, stop, place - HEAD.size, {}))
                self._blocks.append(chunks[-1])
            elif kind == MESSAGE:
                number, _, time, _ = MESSAGE_HEAD.unpack(self._bytes(place, MESSAGE_HEAD.size))
                self._blocks.append(Block(time, time, place - HEAD.size, {number: 1}))
            elif kind == MESSAGE_INDEX and chunks:
                number, length = INDEX_HEAD.unpack(self._bytes(place, INDEX_HEAD.size))
                if length == size - INDEX_HEAD.size:
                    chunks[-1].counts[number] = length // 16
            elif kind == STATISTICS:
                (stated,) = struct.unpack("<Q", self._bytes(place, 8))
            elif kind in (SCHEMA, CHANNEL):
                self._define(kind, self._bytes(place, size))
        # Channels that the summary does not repeat are in chunks, perhaps long before their first message.
        # Some writers index a few channels of a chunk, or none.
        are_known = all(block.counts.keys() <= self.channels.keys() for block in self._blocks)
        if not are_known or stated != sum(sum(block.counts.values()) for block in self._blocks):
            for block in chunks:
                self._look_into(block)
        if kind != FOOTER:
            self.problem, self.missing = "was cut off", self._size - end
            if not self._blocks:
                raise EOFError("it ends before its first complete chunk")

    def _records_outside_chunks(self):
        """Yields the records outside of chunks; after a broken one, it goes on where the summary says."""
        kind, end, place = 0, 0, len(MAGIC)
        while place and kind != FOOTER:
            end = place
            for kind, place, size in records(self._bytes, end, self._size):
                yield kind, place, size
                end = place + size
            place = min((place for place in self._places_in_summary() if place > end), default=0)
            if kind != FOOTER:
                self.problem = "is damaged"

    def _places_in_summary(self):
        """Yields where the summary begins, and each chunk that it names."""
        with contextlib.suppress(*READ_ERRORS):
            end = self._size - FOOTER_TAIL.size
            start, magic = FOOTER_TAIL.unpack(self._bytes(end, FOOTER_TAIL.size))
            if start and magic == MAGIC:
                yield start
                for kind, place, _ in records(self._bytes, start, end):
                    if kind == CHUNK_INDEX:
                        yield struct.unpack("<16xQ", self._bytes(place, 24))[0]

    def _define(self, kind, data):
        """Takes in a schema, or a channel whose schema is known; one that is cut short is left out."""
        with contextlib.suppress(struct.error):
            if kind == SCHEMA:
                self._schemas[struct.unpack_from("<H", data)[0]] = tuple(texts(data, 2, 3))
            elif kind == CHANNEL:
                number, schema = struct.unpack_from("<HH", data)
                topic, encoding = texts(data, 4, 2)
                if schema in self._schemas:
                    name, *definition = self._schemas[schema]
                    self.channels[number] = Channel.of(topic, name, encoding, *definition)

    def _look_into(self, block):
        """Reads the channels and the number of messages in a chunk; an index that names more stays."""
        counts = Counter[int]()
        try:
            for kind, _, data in self._records_in(block):
                self._define(kind, data)
                if kind == MESSAGE:
                    counts[MESSAGE_HEAD.unpack_from(data)[0]] += 1
        except READ_ERRORS:
            self.problem = "is damaged"
        block.counts.update(counts | Counter(block.counts))

    def _load(self, block):
        if self._loaded[0] is not block:
            kind, size = HEAD.unpack(self._bytes(block.place, HEAD.size))
            data = self._bytes(block.place, HEAD.size + size)
            self._loaded = block, memoryview(unpacked(data[HEAD.size :]) if kind == CHUNK else data)
        return self._loaded[1]

    def _records_in(self, block):
        """Yields (kind, place in the block, data) of each record."""
        data = self._load(block)
        for kind, place, size in records(lambda place, size: data[place : place + size], 0, len(data)):
            yield kind, place, data[place : place + size]

    def messages(self, numbers):
        """Yields (time in ns, place, channel's number, data) of some channels in the order of time.

        Data are None where the file is damaged.
        """
        pending: list[tuple] = []
        for index, block in sorted(enumerate(self._blocks), key=lambda entry: entry[1].start):
            if block.counts.keys() & numbers:
                while pending and pending[0][0] < block.start:
                    yield heapq.heappop(pending)
                for message in self._messages_in(index, block, numbers):
                    heapq.heappush(pending, message)
        while pending:
            yield heapq.heappop(pending)

    def _messages_in(self, index, block, numbers):
        messages = []
        lost = Counter({number: block.counts[number] for number in block.counts.keys() & numbers})
        with contextlib.suppress(*READ_ERRORS):
            for kind, place, data in self._records_in(block):
                if kind == MESSAGE:
                    number, _, time, _ = MESSAGE_HEAD.unpack_from(data)
                    if number in numbers:
                        messages.append((time, (index, place), number, bytes(data[MESSAGE_HEAD.size :])))
                        lost[number] -= 1
        missing = [(block.start, (index, -k), number, None) for k, number in enumerate(lost.elements())]
        return messages + missing

    def read(self, place):
        index, start = place
        block = self._blocks[index]
        try:
            data = self._load(block)
            if start <= 0:
                raise EOFError("a message is missing")
            _, size = HEAD.unpack(data[start - HEAD.size : start])
            return bytes(data[start + MESSAGE_HEAD.size : start + size])
        except RecordingError:
            raise
        except READ_ERRORS as error:
            first, last = ((time - self.start) / 1e9 for time in (block.start, block.end))
            raise RecordingError(
                f"{self.name} is damaged from {first:.1f} to {last:.1f} s after its first message ({error}); "
                "what lies before and after can be read; copy it again"
            ) from error
