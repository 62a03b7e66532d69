#pragma once

// Releases the interpreter's lock during a call of the core.
//
// A Python that ends unwinds every other thread that asks for its lock, here through C++ frames:
// the process would abort. So, before it ends, threads that return from the core are held until the
// process is gone.

#include <Python.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <thread>

// For models with fixed and with moving axes.
namespace interpreter {

inline std::atomic<bool> ends{false};
inline std::atomic<int> returning{0};  // number of threads that ask for the lock
inline std::thread::id last_thread;    // which ends the interpreter

// After a fork, no other thread asks for the lock of the new process.
inline void forget_threads() {
    returning = 0;
}

// Hold all other threads that return from the core from now on. Call it with the lock.
inline void hold_threads() {
    last_thread = std::this_thread::get_id();
    ends = true;
    while (returning > 0) {
        Py_BEGIN_ALLOW_THREADS;
        usleep(100);
        Py_END_ALLOW_THREADS;
    }
}

}  // namespace interpreter

namespace gearbox {

class Unlocked {
public:
    Unlocked() : thread(PyEval_SaveThread()) {}
    ~Unlocked() {
        ++interpreter::returning;
        if (interpreter::ends && std::this_thread::get_id() != interpreter::last_thread) {
            --interpreter::returning;
            while (true) pause();
        }
        PyEval_RestoreThread(thread);
        --interpreter::returning;
    }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    PyThreadState* thread;
};

// The result of a function that is called without the lock.
template <class Function>
auto unlocked(Function&& function) {
    Unlocked release;
    return function();
}

}  // namespace gearbox
