#!/usr/bin/env python3
"""A foreign subscriber: shows the telegrams of a leading value, with nothing from Lockstep but leading_value.lcm.

    lcm-gen --python trace.lcm leading_value.lcm        # makes the folder lockstep
    python3 leading_values.py two_presses.line 10 [KEY_FILE]

With the key of the system it says of each telegram whether it is signed by it. Gaps in the sequence are telegrams
that were lost on the way; a telegram that is not valid is not to be followed.
"""
import hashlib
import hmac
import sys

import lockstep
from subscriber import datagrams, decoded, text

CODE = 32  # bytes of HMAC-SHA-256 at the end of a message


def signed(data, key):
    return hmac.compare_digest(data[-CODE:], hmac.new(key, data[:-CODE], hashlib.sha256).digest())


def line(value, data, key):
    flags = [name for bit, name in ((value.VALID, "valid"), (value.POSITION_LED, "position led")) if value.flags & bit]
    if key is not None:
        flags.append("signed" if signed(data, key) else "NOT SIGNED BY THIS KEY")
    return (f"{value.time * 1e-9:.6f} s  {value.sender} #{value.sequence}  position {value.position:.9g}"
            f" + {value.turns} turns  velocity {value.velocity:g}  {', '.join(flags)}")


def main(channel, enough="-1", key_file=None):
    key = None
    if key_file is not None:
        with open(key_file, "rb") as file:
            key = file.read().rstrip(b" \t\r\n")
    shown = 0
    for name, data in datagrams():
        value = decoded(lockstep.leading_value_t, data) if name == channel else None
        if value is None:
            continue
        print(text(line(value, data, key)), flush=True)
        shown += 1
        if shown == int(enough):
            return


if __name__ == "__main__":
    main(*sys.argv[1:])
