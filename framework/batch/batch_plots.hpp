// Pictures that a batch file asks for by name (`plots`), so that a figure of a paper is drawn again by `tack plot DIR`: curves of its runs over
// each other, or a bar per case, with numbers that others have published beside them.
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
    double value = 0;  // as in the table, or of it per `per`
    void fields(Fields& f);
  };

  std::string name, title, x_label, y_label;
  std::vector<CurveOf> curves;
  std::string bars, per;           // columns of results.csv: a bar of `bars`, or of bars / per
  std::vector<std::string> bases;  // whose cases have a bar; empty: all that have such a number
  std::vector<Published> published;
  std::string source;              // of what is published: names its bars
  void fields(Fields& f);
};

// Whether one of the bases is none of `names`: "" or what is wrong.
std::string unknown_base(const BatchPlot& plot, const std::vector<std::string>& names);

// Throws InputError, with the nearest name, for a column that no run of the base has. Bases of which nothing has run are named in a note.
// `runs`: by case.
Plot curves_of(const BatchPlot& plot, const BatchPlan& plan, const std::map<std::string, PlottedRun>& runs);

// Throws InputError, with the nearest name, for a column that the table has not, and where no case has a number.
StackedBars bars_of(const BatchPlot& plot, const BatchPlan& plan, const CsvTexts& table);

}  // namespace tack
