// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/window_style.h"

#include "viewer/viewer_window.h"

#include <vtkAutoInit.h>
#include <vtkObjectFactory.h>

VTK_MODULE_INIT(vtkInteractionStyle)

namespace pds
{

vtkStandardNewMacro(WindowStyle);

void WindowStyle::OnChar()
{
  int x = 0;
  int y = 0;
  Interactor->GetEventPosition(x, y);
  window->press(Interactor->GetKeyCode(), x, y);
}

void WindowStyle::OnTimer()
{
  vtkInteractorStyleTrackballCamera::OnTimer();
  window->poll();
}

void WindowStyle::StartState(int state)
{
  window->start_motion();
  vtkInteractorStyleTrackballCamera::StartState(state);
}

void WindowStyle::StopState()
{
  vtkInteractorStyleTrackballCamera::StopState();
  window->stop_motion();
}

}  // namespace pds
