#pragma once

// Interruption of a run by its caller.

namespace interruption {

// Of a thread that computes.
class Caller {
public:
    virtual ~Caller() = default;

    // Called between steps; an exception ends the run.
    virtual void look() = 0;
};

inline thread_local Caller* caller = nullptr;

}  // namespace interruption
