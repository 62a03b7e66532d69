"""Off-the-shelf solvers on the same model, compared at equal achieved error.

A solver gets the right-hand side of `equations`, the sample times and a tolerance, and gives the
states at those times, from its own interpolation where it has one (see each file). Its time is
that of this, compiled before; transmission errors and losses are worked out of the states after.
"""
