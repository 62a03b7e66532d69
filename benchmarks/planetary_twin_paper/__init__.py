"""Comparison with every table, figure and equation of Salagianni et al. 2017.

Salagianni, Nikolakopoulos, Theodossiades: Dynamic and tribological study of a planetary gearbox
with local nonlinearities, Proc. IMechE Part K 231 (2017) 504-518.
"""
