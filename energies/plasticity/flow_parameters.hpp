// Parameters of plastic flow of solids and sheets in a scene.
#pragma once

namespace tack {

class Fields;

struct FlowParameters {
  double yield_stress = 1e3;  // Pa
  double hardening = 0;       // Pa
  double viscosity = 0;       // Pa s

  // `drawn`: what is in tension where they are measured, "bar" or "strip".
  void fields(Fields& f, const char* drawn);
};

}  // namespace tack
