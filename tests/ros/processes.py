"""Processes and the addresses to which they bind."""

import os
import re
import socket
from pathlib import Path


def working_in(folder: Path) -> list[int]:
    """Processes whose working directory is `folder`."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and (entry / "cwd").resolve(strict=True) == folder:
                found.append(int(entry.name))
        except OSError:
            continue
    return found


def bound_addresses(process: int) -> set[str]:
    """Addresses of the Internet sockets of a process."""
    place = Path(f"/proc/{process}")
    held = {
        match[1] for path in (place / "fd").iterdir() if (match := _SOCKET.match(_target(path)))
    }
    found = set()
    for family, tables in ((socket.AF_INET, ("udp", "tcp")), (socket.AF_INET6, ("udp6", "tcp6"))):
        for table in tables:
            for line in (place / "net" / table).read_text().splitlines()[1:]:
                columns = line.split()
                if columns[9] in held:
                    found.add(_address(family, columns[1].partition(":")[0]))
    return found


_SOCKET = re.compile(r"socket:\[(\d+)\]")


def _target(path: Path) -> str:
    try:
        return os.readlink(path)
    except FileNotFoundError:  # closed in the meantime
        return ""


def _address(family: socket.AddressFamily, written: str) -> str:
    """An address from words of four bytes, each in the byte order of this machine."""
    words = (written[i : i + 8] for i in range(0, len(written), 8))
    return socket.inet_ntop(family, b"".join(bytes.fromhex(word)[::-1] for word in words))


def holding(process: int, name: str) -> bool:
    """Whether a process has mapped a file with `name` in its path."""
    try:
        return name in Path(f"/proc/{process}/maps").read_text()
    except OSError:
        return False
