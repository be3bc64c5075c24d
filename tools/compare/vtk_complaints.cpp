// SPDX-License-Identifier: BSD-3-Clause
#include "compare/vtk_complaints.h"

#include <algorithm>

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

namespace pds
{

namespace
{

class Recorder : public vtkOutputWindow
{
 public:
  static Recorder* New();

  void DisplayText(const char* text) override
  {
    if (first != nullptr && first->empty()) {
      *first = text;
      first->erase(std::min(first->find_last_not_of(" \n") + 1, first->size()));
      std::replace(first->begin(), first->end(), '\n', ' ');
    }
  }

  std::string* first = nullptr;
};
vtkStandardNewMacro(Recorder);

}  // namespace

VtkComplaints::VtkComplaints()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<Recorder> recorder;
  recorder->first = &first_;
  vtkOutputWindow::SetInstance(recorder);
}

VtkComplaints::~VtkComplaints() { vtkOutputWindow::SetInstance(nullptr); }

}  // namespace pds
