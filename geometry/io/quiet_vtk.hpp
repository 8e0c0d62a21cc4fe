// Suppression of VTK's output.
#pragma once

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>

#include <mutex>
#include <string>

namespace tack {

// Collects, during its lifetime, the text that VTK would print on the terminal. VTK has one output
// window per process, hence the lock. Its logger, which repeats that text, is turned off.
class QuietVtk {
 public:
  QuietVtk() : lock_(mutex()), before_(vtkOutputWindow::GetInstance()) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(window_);
  }
  ~QuietVtk() { vtkOutputWindow::SetInstance(before_); }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

  // Returns the first message, without VTK's prefix: "ERROR: In file.cxx, line 3\nClass (0x..):
  // text\n".
  std::string first_message() {
    std::string text = window_->GetOutput();
    if (const auto at = text.find('\n'); at != text.npos) text = text.substr(at + 1);
    text = text.substr(0, text.find('\n'));
    if (const auto at = text.find("): "); at != text.npos) text = text.substr(at + 3);
    return text;
  }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }

  std::lock_guard<std::mutex> lock_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkNew<vtkStringOutputWindow> window_;
};

}  // namespace tack
