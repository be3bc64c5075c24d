// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/load_view.h"
#include "viewer/rerun.h"

#include <chrono>

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTextActor.h>

namespace pds
{

/** \brief The window: keys, picking, and reconstruction while it stays alive. */
class ViewerWindow
{
 public:
  /** \param view, source must outlive this object */
  ViewerWindow(View& view, const ViewSource& source, const ViewerOptions& options);

  /** \brief Shows the window, reconstructs what is to be reconstructed, and serves it until it is closed. */
  void run();

  /** \brief Opens the window without serving it, for tests. */
  void open();

  /** \brief What a key does; \a x and \a y are the pointer's place in pixels from the lower left. */
  void press(char key, int x, int y);

  /** \brief Shows the progress of a reconstruction that runs, its result when it is there, and all details again when
   * the view has come to rest. */
  void poll();

  void start_motion();  ///< the mouse has begun to move the view
  void stop_motion();

  [[nodiscard]] bool is_busy() const { return rerun_.is_busy(); }
  [[nodiscard]] vtkRenderWindow* window() { return window_; }
  [[nodiscard]] vtkRenderWindowInteractor* interactor() { return interactor_; }
  [[nodiscard]] std::string status() const { return status_->GetInput(); }  ///< the line at the bottom

 private:
  void draw();
  void say(const std::string& text);
  [[nodiscard]] std::string summary() const;
  void take_result(Rerun::Result result);
  void refine();
  void pick(int x, int y);
  void toggle(const LayerName& layer);
  void change_options(char key);
  void save_camera();
  [[nodiscard]] bool change_look(char key);  ///< whether that is what the key does, and it is to be drawn

  using Clock = std::chrono::steady_clock;

  View& view_;
  const ViewSource& source_;
  Options options_;
  bool chooses_layers_ = true;  ///< the user has said which, and no result may change them
  bool is_moving_ = false;
  Clock::time_point last_change_;
  Rerun rerun_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkTextActor> status_;
  vtkNew<vtkTextActor> help_;
  vtkNew<vtkCamera> saved_camera_;
};

}  // namespace pds
