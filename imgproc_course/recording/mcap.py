"""MCAP files: chunks with a CRC, and what can still be read of a file that was cut off.

The format: https://mcap.dev/spec
"""

import struct
from binascii import crc32
from types import MappingProxyType
from typing import Any, NamedTuple

from backports.zstd import ZstdError
from rosbags.rosbag2 import Reader, ReaderError, StoragePlugin, Writer
from rosbags.rosbag2.reader import DirectoryReader
from rosbags.rosbag2.storage_mcap import DECOMPRESSORS, ChunkInfo, McapReader, McapWriter, decompress

CHUNK = 0x06
HEAD = struct.Struct("<BQ")  # of a record: what it is, its length
CHUNK_HEAD = struct.Struct("<QQQII")  # start, end, size, CRC, length of the compression's name
CRC_PLACE = HEAD.size + 24  # in a chunk
MAGIC = b"\x89MCAP0\r\n"


class _CheckedMcapWriter(McapWriter):
    """Writes a CRC into each chunk, where rosbags writes 0."""

    def close_chunk(self):
        start, crc = self.bio.tell(), crc32(self.chunk.bio.getvalue())
        super().close_chunk()
        end = self.bio.tell()
        self.bio.seek(start + CRC_PLACE)
        self.bio.write(crc.to_bytes(4, "little"))
        self.bio.seek(end)


class CheckedWriter(Writer):
    """rosbags' Writer, with a CRC in each chunk of an MCAP file."""

    STORAGE_PLUGINS = MappingProxyType({**Writer.STORAGE_PLUGINS, StoragePlugin.MCAP: _CheckedMcapWriter})


class Chunk(NamedTuple):
    """A chunk of a file: times in ns, its place and whole length in bytes, and how its data are packed."""

    start: int
    end: int
    place: int
    length: int
    size: int
    crc: int
    compression: str

    @property
    def packed(self):
        """Bytes of its data in the file."""
        return self.place + self.length - self.data_place

    @property
    def data_place(self):
        return self.place + HEAD.size + CHUNK_HEAD.size + len(self.compression) + 8

    def is_whole(self, file):
        """Whether its data can be unpacked and have its CRC; True also if that cannot be known."""
        if self.compression not in DECOMPRESSORS:
            return True
        file.seek(self.data_place)
        data = file.read(self.packed)
        try:
            decompress(data, self.compression, self.size, self.crc)
        except (ReaderError, ZstdError, RuntimeError, ValueError, EOFError, MemoryError):
            return False
        return True


def scan_chunks(file):
    """The complete chunks of an open MCAP file, and the place where its last complete record ends."""
    length, place, chunks = file.seek(0, 2), len(MAGIC), []
    while place + HEAD.size <= length:
        file.seek(place)
        kind, size = HEAD.unpack(file.read(HEAD.size))
        if place + HEAD.size + size > length or not kind:
            break
        if kind == CHUNK:
            start, end, unpacked, crc, name = CHUNK_HEAD.unpack(file.read(CHUNK_HEAD.size))
            compression = file.read(name).decode()
            chunks.append(Chunk(start, end, place, HEAD.size + size, unpacked, crc, compression))
        place += HEAD.size + size
    return chunks, place


def damaged_spans(path):
    """(start, end) in ns of each chunk of an MCAP file that is damaged, and when its first message was."""
    with path.open("rb") as file:
        chunks, _ = scan_chunks(file)
        spans = [(chunk.start, chunk.end) for chunk in chunks if not chunk.is_whole(file)]
    return spans, min((chunk.start for chunk in chunks), default=0)


class CutMcapReader(McapReader):
    """Reads also an MCAP file without its end; then `missing` is the number of bytes of its broken piece."""

    missing: int | None = None

    def _open(self) -> None:
        try:
            super()._open()
        except (ReaderError, OSError):
            if not self.data_start or self._has_end():
                raise
            self._open_without_end()

    def _has_end(self):
        file: Any = self.bio
        file.seek(-min(len(MAGIC), file.seek(0, 2)), 2)
        return file.read() == MAGIC

    def _open_without_end(self):
        file: Any = self.bio
        chunks, self.data_end = scan_chunks(file)
        if not chunks:
            raise ReaderError("it ends before its first complete chunk")
        self.meta_scan()
        statistics: Any = self.statistics
        counts = statistics.channel_message_counts
        self.connections = [
            connection._replace(msgcount=counts.get(connection.id, 0)) for connection in self.connections
        ]
        # Which channels a chunk has is not known without its index: perhaps all.
        channels = dict.fromkeys(self.channels, 1)
        self.chunks = [
            ChunkInfo(c.start, c.end, c.place, c.length, {}, 0, c.compression, c.packed, c.size, channels)
            for c in chunks
        ]
        self.missing = file.seek(0, 2) - self.data_end


class _CutDirectoryReader(DirectoryReader):
    STORAGE_PLUGINS = MappingProxyType({**DirectoryReader.STORAGE_PLUGINS, "mcap": CutMcapReader})


class CutReader(Reader):
    """rosbags' Reader, also of a recording in MCAP that was cut off."""

    STORAGE_PLUGINS = MappingProxyType(
        {**Reader.STORAGE_PLUGINS, "dir": _CutDirectoryReader, ".mcap": CutMcapReader}
    )
