"""Writes a grey JPEG of 8 by 8 pixels: one table of quantities, one code for each kind of coefficient, one block."""

import sys


def segment(marker: int, content: bytes) -> bytes:
    return bytes((0xFF, marker)) + (2 + len(content)).to_bytes(2, "big") + content


def one_code(kind: int) -> bytes:
    """A table of Huffman's with the code 0 alone, which says that nothing more comes."""
    return segment(0xC4, bytes((kind << 4, 1, *(0 for _ in range(15)), 0)))


quantities = segment(0xDB, bytes((0, *(16 for _ in range(64)))))
frame = segment(0xC0, bytes((8, 0, 8, 0, 8, 1, 1, 0x11, 0)))
scan = segment(0xDA, bytes((1, 1, 0, 0, 63, 0)))
block = bytes((0b00111111,))  # both codes, and ones to the end of the byte
sys.stdout.buffer.write(b"\xff\xd8" + quantities + frame + one_code(0) + one_code(1) + scan + block + b"\xff\xd9")
