"""Lets the generators of ROS messages share what one of them has parsed.

Ten generators run for each package, and each parses all of its messages again, which takes most of
their time (https://github.com/ros2/rosidl/pull/989 repairs it in ROS itself). Python imports this
module when it starts, if its folder is on PYTHONPATH.
"""

import hashlib
import os
import pickle
import sys
from pathlib import Path

if "--generator-arguments-file" in sys.orig_argv:
    from rosidl_parser import parser

    _parse = parser.get_ast_from_idl_string

    def _parse_once(text: str) -> object:
        name = hashlib.sha256(text.encode()).hexdigest()
        kept = Path(os.environ["PARSED_MESSAGES"], name)
        if kept.exists():
            return pickle.loads(kept.read_bytes())
        tree = _parse(text)
        unfinished = kept.with_suffix(f".{os.getpid()}")
        unfinished.write_bytes(pickle.dumps(tree))
        unfinished.rename(kept)  # others read whole trees alone
        return tree

    parser.get_ast_from_idl_string = _parse_once
