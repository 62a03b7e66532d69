#pragma once

// Releases the interpreter's lock during a call of the core.
//
// Python would unwind a thread that returns while the interpreter ends, through C++ frames: the
// process would abort. The thread waits for the end of the process instead.

#include <Python.h>
#include <unistd.h>

namespace gearbox {

class Unlocked {
public:
    Unlocked() : thread(PyEval_SaveThread()) {}
    ~Unlocked() {
        while (is_ending()) pause();
        PyEval_RestoreThread(thread);
    }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    static bool is_ending() {
#if PY_VERSION_HEX >= 0x030D0000
        return Py_IsFinalizing();
#else
        return _Py_IsFinalizing();
#endif
    }

    PyThreadState* thread;
};

}  // namespace gearbox
