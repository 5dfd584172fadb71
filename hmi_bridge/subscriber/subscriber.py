#!/usr/bin/env python3
"""A foreign subscriber: shows the rows of a trace and what happens, with nothing from Lockstep but trace.lcm.

    lcm-gen --python trace.lcm        # makes the folder lockstep
    python3 subscriber.py ROTARY_KNIFE 10

It needs no LCM library: a message of less than 64 KiB is one datagram of magic number, sequence number, channel
and data. Larger ones come in fragments, which this example leaves out.
"""
import socket
import struct
import sys

import lockstep

GROUP, PORT = "239.255.76.67", 7667
SMALL = 0x4C433032  # "LC02"


def text(characters):
    """What strangers wrote, without what a terminal would obey."""
    return "".join(c if c.isprintable() else "?" for c in characters)


def decoded(kind, data):
    """The message; None if the bytes are none. Anybody may send anything."""
    try:
        return kind.decode(data)
    except (ValueError, IndexError, MemoryError, OverflowError, struct.error):
        return None


def datagrams():
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind((GROUP, PORT))
    member = struct.pack("4sL", socket.inet_aton(GROUP), socket.INADDR_ANY)
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    while True:
        data = receiver.recv(65536)
        if len(data) < 9 or struct.unpack(">I", data[:4])[0] != SMALL:
            continue
        end = data.find(b"\0", 8)
        if end > 0:
            yield data[8:end].decode("ascii", "replace"), data[end + 1:]


def main(channel="LOCKSTEP", enough="-1"):
    header, rows = None, 0
    for name, data in datagrams():
        if name == channel + "_HEADER":
            header = decoded(lockstep.trace_header_t, data) or header
        elif name == channel + "_EVENTS":
            event = decoded(lockstep.event_t, data)
            if event is None:
                continue
            what = f" {event.number} {event.text}" if event.number else ""
            print(text(f"{event.t * 1e-9:.6f} s  {event.kind}: {event.source}{what}"), flush=True)
        elif name == channel and header is not None:
            row = decoded(lockstep.trace_row_t, data)
            if row is None or row.header_id != header.id:
                continue  # its header comes within a second
            values = "  ".join(f"{n} {v:g}{u}" for n, v, u in zip(header.names, row.values, header.units))
            print(text(f"{row.t * 1e-9:.6f} s  {values}"), flush=True)
            rows += 1
            if rows == int(enough):
                return


if __name__ == "__main__":
    main(*sys.argv[1:])
