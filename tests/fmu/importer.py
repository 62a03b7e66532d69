"""An importing tool with the C interface of FMI 3.0 alone: no FMPy, no planetary_twin_py."""

import ctypes
import platform
import zipfile
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from xml.etree import ElementTree

LOG = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)
OK, ERROR = 0, 3


class Refused(Exception):
    """A call that did not return fmi3OK, with the message that was logged."""


class Slave:
    """An instance of an FMU that is unpacked into `folder`."""

    def __init__(self, fmu, folder, tolerance=None, start=None, start_time=0.0):
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(folder)
        root = ElementTree.parse(folder / "modelDescription.xml").getroot()
        found = root.find("ModelVariables")
        self.reference = {each.get("name"): int(each.get("valueReference")) for each in found}
        identifier = root.find("CoSimulation").get("modelIdentifier")
        library = f"binaries/{platform.machine()}-linux/{identifier}.so"
        self._library = ctypes.CDLL(str(folder / library))
        self.messages = []
        self._log = LOG(lambda _, __, ___, text: self.messages.append(text.decode()))
        make = self._library.fmi3InstantiateCoSimulation
        make.restype = c_void_p
        handle = make(
            b"slave", root.get("instantiationToken").encode(), str(folder / "resources").encode(),
            c_bool(False), c_bool(True), c_bool(False), c_bool(False), None, c_size_t(0), None,
            self._log, None,
        )  # fmt: skip
        if not handle:
            raise Refused(self.messages[-1])
        self._handle = c_void_p(handle)
        self.begin(tolerance, start or {}, start_time)

    def begin(self, tolerance=None, start=None, start_time=0.0):
        """Initialise; `start` are values of variables."""
        self.time = start_time
        self._call(
            "fmi3EnterInitializationMode", c_bool(tolerance is not None),
            c_double(tolerance or 0.0), c_double(start_time), c_bool(False), c_double(0.0),
        )  # fmt: skip
        self.set(**(start or {}))
        self._call("fmi3ExitInitializationMode")

    def _call(self, name, *arguments):
        if getattr(self._library, name)(self._handle, *arguments) != OK:
            raise Refused(self.messages[-1])

    def _arrays(self, names):
        count = len(names)
        return (c_uint32 * count)(*(self.reference[name] for name in names)), count

    def get(self, *names):
        """Values of variables."""
        references, count = self._arrays(names)
        values = (c_double * count)()
        self._call("fmi3GetFloat64", references, c_size_t(count), values, c_size_t(count))
        return list(values)

    def set(self, **named):
        """Set variables; two underscores stand for the point in a name."""
        names = [name.replace("__", ".") for name in named]
        if names:
            references, count = self._arrays(names)
            values = (c_double * count)(*named.values())
            self._call("fmi3SetFloat64", references, c_size_t(count), values, c_size_t(count))

    def step(self, size):
        """Simulate so many seconds."""
        flags, reached = [c_bool() for _ in range(3)], c_double()
        self._call(
            "fmi3DoStep", c_double(self.time), c_double(size), c_bool(True),
            *map(byref, flags), byref(reached),
        )  # fmt: skip
        self.time = reached.value

    def state(self):
        """A copy of the state."""
        kept = c_void_p()
        self._call("fmi3GetFMUState", byref(kept))
        return kept, self.time

    def restore(self, state):
        """Restore a copy of the state."""
        self._call("fmi3SetFMUState", state[0])
        self.time = state[1]

    def free(self, state):
        """Free a copy."""
        self._call("fmi3FreeFMUState", byref(state[0]))

    def reset(self):
        """Back to the state before the initialisation."""
        self._call("fmi3Reset")

    def end(self):
        """Terminate and free."""
        self._call("fmi3Terminate")
        self._library.fmi3FreeInstance(self._handle)
