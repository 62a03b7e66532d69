#pragma once

// Without the interpreter's lock, for the time of a call of the core.
//
// A thread that comes back while the interpreter ends would be unwound by Python, through C++
// frames that may not be: the process would abort. It waits for the end of the process instead.

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
