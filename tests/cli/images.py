"""Small image files, written and read without the program's own image library.

An image is (width, height, rows): `rows` holds height lists of width pixels, a pixel a tuple of channels."""
import math
import struct
import zlib


def grey(*rows):
    """An image of grey pixels, a list of values a row."""
    return len(rows[0]), len(rows), [[(v, v, v) for v in row] for row in rows]


def write_pfm(path, image):
    width, height, rows = image
    kind = b'PF' if len(rows[0][0]) == 3 else b'Pf'
    body = b''.join(struct.pack('<%df' % len(p), *p) for row in reversed(rows) for p in row)
    open(path, 'wb').write(kind + b'\n%d %d\n-1.0\n' % (width, height) + body)


def write_png(path, image, bits=8):
    """Levels from 0 to 2^bits - 1; one, three or four channels."""
    width, height, rows = image
    channels = len(rows[0][0])
    layout = '>%d%s' % (width * channels, 'B' if bits == 8 else 'H')
    data = b''.join(b'\0' + struct.pack(layout, *[v for p in row for v in p]) for row in rows)

    def chunk(kind, body):
        return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
    head = struct.pack('>2I5B', width, height, bits, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    open(path, 'wb').write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', zlib.compress(data)) +
                           chunk(b'IEND', b''))


def write_hdr(path, image):
    """Radiance RGBE without run lengths; mantissas are cut to 8 bits."""
    width, height, rows = image
    body = b''
    for row in rows:
        for pixel in row:
            exponent = math.frexp(max(pixel))[1] if max(pixel) > 0 else -128
            body += bytes([int(v * 2.0 ** (8 - exponent)) for v in pixel] + [exponent + 128])
    open(path, 'wb').write(b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n' % (height, width) + body)


def write_tiff(path, image, bits=32):
    """Uncompressed RGB: 32-bit floats, or 8-bit levels."""
    width, height, rows = image
    layout = '<%d%s' % (width * 3, 'f' if bits == 32 else 'B')
    body = b''.join(struct.pack(layout, *[v for p in row for v in p]) for row in rows)
    tags = [(256, 3, 1, width), (257, 3, 1, height), (258, 3, 3, 8), (259, 3, 1, 1), (262, 3, 1, 2), (273, 4, 1, 20),
            (277, 3, 1, 3), (278, 3, 1, height), (279, 4, 1, len(body)), (284, 3, 1, 1), (339, 3, 3, 14)]
    formats = struct.pack('<3H', *[bits] * 3) + struct.pack('<3H', *[3 if bits == 32 else 1] * 3)
    directory = struct.pack('<H', len(tags)) + b''.join(struct.pack('<HHII', *t) for t in tags) + struct.pack('<I', 0)
    body += b'\0' * (len(body) % 2)
    open(path, 'wb').write(struct.pack('<2sHI', b'II', 42, 20 + len(body)) + formats + body + directory)


def write_exr(path, image, names=('R', 'G', 'B')):
    """Uncompressed scan lines of 32-bit floats; `names` are the channels of a pixel's tuple."""
    width, height, rows = image
    order = sorted(range(len(names)), key=lambda i: names[i])
    channels = b''.join(names[i].encode() + b'\0' + struct.pack('<iB3xii', 2, 0, 1, 1) for i in order) + b'\0'
    window = struct.pack('<4i', 0, 0, width - 1, height - 1)
    head = b''.join(name + b'\0' + kind + b'\0' + struct.pack('<i', len(value)) + value for name, kind, value in [
        (b'channels', b'chlist', channels), (b'compression', b'compression', b'\0'), (b'dataWindow', b'box2i', window),
        (b'displayWindow', b'box2i', window), (b'lineOrder', b'lineOrder', b'\0'),
        (b'pixelAspectRatio', b'float', struct.pack('<f', 1)), (b'screenWindowCenter', b'v2f', struct.pack('<2f', 0, 0)),
        (b'screenWindowWidth', b'float', struct.pack('<f', 1))]) + b'\0'
    start = 8 + len(head) + 8 * height
    size = 4 * width * len(names)
    offsets = struct.pack('<%dQ' % height, *[start + y * (8 + size) for y in range(height)])
    lines = b''.join(struct.pack('<2i', y, size) + b''.join(struct.pack('<f', p[i]) for i in order for p in row)
                     for y, row in enumerate(rows))
    open(path, 'wb').write(struct.pack('<2i', 20000630, 2) + head + offsets + lines)


def read_png(path):
    """The pixels of an 8-bit RGB PNG, a list a row, and its texts by name."""
    data, position, packed, texts = open(path, 'rb').read(), 8, b'', {}
    while position < len(data):
        length, kind = struct.unpack('>I4s', data[position:position + 8])
        body = data[position + 8:position + 8 + length]
        position += 12 + length
        if kind == b'IHDR':
            width, height, bits, color = struct.unpack('>2I2B', body[:10])
            assert (bits, color) == (8, 2), (bits, color)
        elif kind == b'IDAT':
            packed += body
        elif kind == b'tEXt':
            name, text = body.split(b'\0', 1)
            texts[name.decode()] = text.decode('latin-1')
    raw, stride, above, rows = zlib.decompress(packed), 3 * width, bytes(3 * width), []
    for y in range(height):
        how, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = (line[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            nearest = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            line[i] = line[i] + (0, left, up, (left + up) // 2, nearest)[how] & 255
        above = bytes(line)
        rows.append([tuple(line[i:i + 3]) for i in range(0, stride, 3)])
    return rows, texts
