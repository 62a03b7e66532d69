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

cmake_language(DEFER CALL drop_missing_include_directories)
