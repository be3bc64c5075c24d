# SPDX-License-Identifier: BSD-3-Clause
# Manual pages of the programs, from what they print for --help, and the reference of the public headers (target doc).
find_program(HELP2MAN help2man)
find_program(GZIP gzip)
mark_as_advanced(HELP2MAN GZIP)

set(manual_pages "")
function(pds_add_manual_page target program what_it_does)
  set(others ${manual_page_programs})
  list(REMOVE_ITEM others ${program})
  set(page "${PROJECT_BINARY_DIR}/man/${program}.1")
  add_custom_command(
    OUTPUT "${page}" "${page}.gz"
    COMMAND "${PROJECT_SOURCE_DIR}/docs/man/make_man_page.sh" "$<TARGET_FILE:${target}>" "${what_it_does}"
            "${page}" ${others}
    COMMAND "${GZIP}" -9 --no-name --force --keep "${page}"
    DEPENDS ${target} "${PROJECT_SOURCE_DIR}/docs/man/make_man_page.sh"
    COMMENT "Manual page of ${program}"
    VERBATIM)
  set(manual_pages ${manual_pages} "${page}.gz" PARENT_SCOPE)
endfunction()

if(TARGET pcl_pds_recon_tool)
  if(HELP2MAN AND GZIP AND NOT CMAKE_CROSSCOMPILING)
    file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/man")
    set(manual_page_programs pcl_pds_recon)
    foreach(program pcl_pds_compare pcl_pds_viewer)
      if(TARGET ${program})
        list(APPEND manual_page_programs ${program})
      endif()
    endforeach()
    pds_add_manual_page(pcl_pds_recon_tool pcl_pds_recon "turn a point cloud into a manifold triangle mesh")
    if(TARGET pcl_pds_compare)
      pds_add_manual_page(pcl_pds_compare pcl_pds_compare "measure how far a mesh is from a scan or another mesh")
    endif()
    if(TARGET pcl_pds_viewer)
      pds_add_manual_page(pcl_pds_viewer pcl_pds_viewer "show a point cloud and the steps of its reconstruction")
    endif()
    add_custom_target(man ALL DEPENDS ${manual_pages})
  else()
    list(APPEND left_out "manual pages (not found: help2man)")
  endif()
endif()

find_package(Doxygen 1.9.4 QUIET)
if(DOXYGEN_FOUND)
  configure_file(docs/Doxyfile.in Doxyfile @ONLY)
  add_custom_target(
    doc
    COMMAND "${DOXYGEN_EXECUTABLE}" "${PROJECT_BINARY_DIR}/Doxyfile"
    COMMENT "Reference of the public headers in ${PROJECT_BINARY_DIR}/doc/html"
    VERBATIM)
else()
  list(APPEND left_out "reference of the headers (not found: doxygen)")
endif()
