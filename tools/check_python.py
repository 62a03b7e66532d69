"""Says in one line why this interpreter cannot carry the twin; silent if it can.

Runs under any Python, so its syntax is the oldest that every one of them reads.
"""

import os
import sys
import sysconfig

try:
    import ensurepip  # noqa: F401
    import venv  # noqa: F401
except ImportError:
    VENV = False
else:
    VENV = True

if not (3, 11) <= sys.version_info[:2] <= (3, 13):
    sys.exit("is Python " + sys.version.split()[0])
if sys.implementation.name != "cpython" or sys.maxsize < 2**32:
    sys.exit("is not a 64-bit CPython")
if not VENV:
    sys.exit("lacks the module venv (Debian: apt install python3-venv)")
if not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")):
    sys.exit("lacks the header Python.h (Debian: apt install python3-dev)")
