// Figures that a batch file defines (`plots`), drawn by `tack plot DIR`: curves of several runs in
// one picture, or a bar for each case, with published values across them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/output/csv.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

struct BatchPlan;
struct PlottedRun;

struct BatchPlot {
  struct CurveOf {
    std::string base, x = "time", y;  // columns of its probes.csv or steps.csv
    std::string title;                // empty: the case and y
    void fields(Fields& f);
  };
  struct Published {
    std::string base;
    double value = 0;  // in the unit of the table's column, or of the quotient with `per`
    void fields(Fields& f);
  };

  std::string name, title, x_label, y_label;
  std::vector<double> x_range;  // of curves, SI; empty: all
  std::vector<CurveOf> curves;
  std::string bars, per;           // columns of results.csv: a bar of `bars`, or of bars / per
  std::vector<std::string> bases;  // of the cases with a bar; empty: all with a number
  std::vector<Published> published;
  std::string source;  // source of the published values: stands beside them
  void fields(Fields& f);
};

// Returns an error message if a base of the plot is not in `names`; "" otherwise.
std::string unknown_base(const BatchPlot& plot, const std::vector<std::string>& names);

// Returns the curves of a plot. `runs`: by case name. Throws InputError, with the nearest name, for
// a column that no run of the base has. Bases without a finished run are named in a note.
Plot curves_of(const BatchPlot& plot, const BatchPlan& plan,
               const std::map<std::string, PlottedRun>& runs);

// Returns the bars of a plot. Throws InputError, with the nearest name, for a column that the table
// lacks, and if no case has a number.
StackedBars bars_of(const BatchPlot& plot, const BatchPlan& plan, const CsvTexts& table);

}  // namespace tack
