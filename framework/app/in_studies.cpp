// The commands that the program tack leaves to tack_studies.
#include "framework/app/commands.hpp"

namespace tack {

int batch_command(const BatchOptions&) { throw InStudies{}; }
int calibrate_command(const CalibrateOptions&) { throw InStudies{}; }
int compare_command(const CompareOptions&) { throw InStudies{}; }
int describe_command(const ListOptions&) { throw InStudies{}; }
int law_command(const LawOptions&) { throw InStudies{}; }
int picture_command(const CheckOptions&) { throw InStudies{}; }
int plot_command(const PlotOptions&) { throw InStudies{}; }
int render_command(const RenderOptions&) { throw InStudies{}; }
int report_command(const ReportOptions&) { throw InStudies{}; }
int suite_command(const SuiteOptions&) { throw InStudies{}; }
int view_command(const ViewOptions&) { throw InStudies{}; }

}  // namespace tack
