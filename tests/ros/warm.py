"""Imports and loads what nodes need at their start, in the process from which tests fork them."""

import gc
import inspect
import sys

import diagnostic_msgs.msg
import planetary_twin_msgs.msg
import planetary_twin_msgs.srv
import rcl_interfaces.msg
import rcl_interfaces.srv
import sensor_msgs.msg
import std_msgs.msg
import std_srvs.srv
from rclpy.type_support import check_for_type_support

import planetary_twin_py as pt
import planetary_twin_py.cli

TYPES = (
    diagnostic_msgs.msg,
    planetary_twin_msgs.msg,
    planetary_twin_msgs.srv,
    rcl_interfaces.msg,
    rcl_interfaces.srv,
    sensor_msgs.msg,
    std_msgs.msg,
    std_srvs.srv,
)

for module in TYPES:
    for kind in vars(module).values():
        if isinstance(kind, type):
            check_for_type_support(kind)
pt.Twin(pt.load_scene("paper")).advance(0.02)
inspect.getmodule(sys._getframe())  # fills the table of modules with which rclpy finds who logs
gc.freeze()  # collections in a node pass over what it shares with this process
