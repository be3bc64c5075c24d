// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

namespace pds
{

class ViewerWindow;

/** \brief Mouse as usual in VTK; keys as in key_help(). */
class WindowStyle : public vtkInteractorStyleTrackballCamera
{
 public:
  static WindowStyle* New();

  void OnChar() override;
  void OnTimer() override;
  void StartState(int state) override;
  void StopState() override;

  ViewerWindow* window = nullptr;
};

}  // namespace pds
