# SPDX-License-Identifier: BSD-3-Clause
# <model-viewer> (Apache-2.0), which turns the mesh in the pages of --html. npm fetches it once per build directory from
# the registry that it is set to; what comes is known by its hash. MODEL_VIEWER_SCRIPT and MODEL_VIEWER_LICENSE are set
# if it is there, otherwise MODEL_VIEWER_MISSING says why not.
set(model_viewer_package "@google/model-viewer@4.4.0")
set(model_viewer_directory "${PROJECT_BINARY_DIR}/model-viewer")
set(model_viewer_archive "${model_viewer_directory}/google-model-viewer-4.4.0.tgz")
set(model_viewer_sha512
    f33d52079b0f9732a86a4e66771fc3df56eb05a90f626dd08b7d447c0b9c1c052bb6b1c709b69bca990abd2c11798854a4f6b1c89e3aa13e3bb9613f86bb3567
)

if(NOT EXISTS "${model_viewer_archive}")
  find_program(NPM npm)
  mark_as_advanced(NPM)
  file(MAKE_DIRECTORY "${model_viewer_directory}")
  if(NPM)
    message(STATUS "Fetching ${model_viewer_package}")
    # One try and no more than a minute: without a network a build is not to wait.
    execute_process(
      COMMAND "${NPM}" pack --fetch-retries=0 --prefer-offline "${model_viewer_package}"
      WORKING_DIRECTORY "${model_viewer_directory}"
      TIMEOUT 60 OUTPUT_QUIET ERROR_QUIET)
  endif()
endif()

if(EXISTS "${model_viewer_archive}")
  file(SHA512 "${model_viewer_archive}" found_sha512)
  if(found_sha512 STREQUAL model_viewer_sha512)
    set(MODEL_VIEWER_SCRIPT "${model_viewer_directory}/package/dist/model-viewer-umd.min.js")
    set(MODEL_VIEWER_LICENSE "${model_viewer_directory}/package/LICENSE")
    if(NOT EXISTS "${MODEL_VIEWER_SCRIPT}")
      execute_process(COMMAND "${CMAKE_COMMAND}" -E tar xzf "${model_viewer_archive}" --
                              package/dist/model-viewer-umd.min.js package/LICENSE
                      WORKING_DIRECTORY "${model_viewer_directory}")
    endif()
  else()
    set(MODEL_VIEWER_MISSING "${model_viewer_archive} is not the file expected, remove it")
  endif()
else()
  set(MODEL_VIEWER_MISSING
      "not fetched: run 'npm pack ${model_viewer_package}' where there is a network and put the file into ${model_viewer_directory}"
  )
endif()
