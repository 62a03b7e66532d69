#pragma once

// The library of the gearbox for the processor that an FMU finds itself on.

#include <memory>
#include <string>

#include "fmu/instance.hpp"

namespace fmu {

// An instance of the scene in a folder of resources; null where there is none, and then why.
std::unique_ptr<Instance> load(const std::string& resources, Complaint& complaint);

}  // namespace fmu
