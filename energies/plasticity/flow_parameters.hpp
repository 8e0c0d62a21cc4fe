// Scene parameters of plastic flow, for solids and sheets.
#pragma once

namespace tack {

class Fields;

struct FlowParameters {
  double yield_stress = 1e3;  // Pa
  double hardening = 0;       // Pa
  double viscosity = 0;       // Pa s

  // drawn: the specimen of the tension test, "bar" or "strip".
  void fields(Fields& f, const char* drawn);
};

}  // namespace tack
