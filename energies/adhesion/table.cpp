// A law given as a table in a file: the traction by gap of its rows, with cubic pieces that are monotone between rows. The energy is their exact
// integral.
#include "energies/adhesion/curve_adhesion.hpp"
#include "energies/adhesion/traction_table.hpp"

namespace tack {

class TableAdhesion : public CurveAdhesion<TableAdhesion> {
 public:
  void fields(Fields& f) override {
    table_.fields(f);
    f.flag("cut", cut_, "the traction may jump to 0 after the last row");
  }
  void prepare(const PairMaterials& m) override {
    TractionTable::Read read = table_.read();
    check_traction(read.curve, cut_, m.contact_distance, "adhesion table: " + table_.file);
    doubts_ = read.doubts;
    rows_ = read.rows;
    set(std::move(read.curve));
  }
  std::string note() const override { return fmt::format("table: {} rows of {}", rows_, table_.file); }
  std::vector<std::string> warnings() const override { return doubts_; }

 private:
  TractionTable table_;
  bool cut_ = false;
  int rows_ = 0;
  std::vector<std::string> doubts_;
};

TACK_REGISTER(AdhesionLaw, TableAdhesion, "table", "Traction-separation law given as a table of gap and traction in a file.",
              "Fritsch, Butland 1984, A method for constructing local monotone piecewise cubic interpolants");

}  // namespace tack
