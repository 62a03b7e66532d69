#pragma once

// Loads the library of the gearbox that fits the processor.

#include <memory>
#include <string>

#include "fmu/instance.hpp"

namespace fmu {

// Make an instance of the scene in a folder of resources. If it fails, it returns null and sets the
// message.
std::unique_ptr<Instance> load(const std::string& resources, ErrorMessage& error);

}  // namespace fmu
