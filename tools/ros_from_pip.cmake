# Lets an interface package build against ROS 2 from pip wheels; a real ROS does not need it.
#
# Passed as -DCMAKE_PROJECT_<package>_INCLUDE=..., so CMake reads it right after project() and the
# package itself stays plain ROS. The wheels' CMake exports name include directories of the machine
# the wheels were built on; CMake refuses to generate with such a target. Once the package's
# CMakeLists.txt is through, every directory that does not exist is taken out.

function(drop_missing_include_directories)
  get_directory_property(targets IMPORTED_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
    if(NOT directories)
      continue()
    endif()
    set(kept "")
    foreach(directory IN LISTS directories)
      if(directory MATCHES "^\\$<" OR EXISTS "${directory}")
        list(APPEND kept "${directory}")
      endif()
    endforeach()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${kept}")
  endforeach()
endfunction()

# The type supports of messages are one small C++ file each, of which nearly all is the same headers.
# Compiled together they take a third of the time.
function(compile_type_supports_together)
  get_directory_property(targets BUILDSYSTEM_TARGETS)
  list(FILTER targets INCLUDE REGEX "__rosidl_typesupport_")
  set_target_properties(${targets} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 9)
endfunction()

cmake_language(DEFER CALL drop_missing_include_directories)
cmake_language(DEFER CALL compile_type_supports_together)
