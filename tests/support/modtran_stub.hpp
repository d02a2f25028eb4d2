#pragma once

#include <sys/stat.h>

#include <filesystem>

#include "materials/base/files.hpp"

/// A program in MODTRAN's place: air of 0.1 per km at 300 K, 0.2 to space, whatever the wavelength.
/// It reads ranges and wavenumbers from the cards of its tape5 and prints a tape7 of what is true.
inline void write_modtran_stub(const std::filesystem::path& file) {
    diurna::write_whole_file(file, R"(#!/bin/sh
awk '
function head() {
  print "T F 6    1    1    0    6    6    6    6    6    6    1    0    0   0.000   0.00"
  print "    1    1    1    0    0    0  23.00000   0.00000   0.00000   0.00000   0.00000"
  print " -99.000 -99.000 -99.000"; print " -99.00000"; print "   36STUB"
  printf "%10.5f%10.5f%10.5f%10.5f\n", 0, 0, 0, r
  print "  -99"; print " -99.0"; printf "%10.1f%10.1f%10.1f%10.1f\n", v1, v2, 5, 10; print "    0"
  print "    FREQ  TOT_TRANS  PTH_THRML  THRML_SCT  SURF_EMIS   SOL_SCAT  SING_SCAT  GRND_RFLT  DRCT_RFLT  TOTAL_RAD  REF_SOL  SOL@OBS   DEPTH DIR_EM    TOA_SUN BBODY_T[K]"
}
FNR % 6 == 1 { type = substr($0, 6, 5) + 0 }
FNR % 6 == 4 { r = substr($0, 31, 10) + 0; if (type == 3) r = 2 / 1 }
FNR % 6 == 5 { v1 = substr($0, 1, 10) + 0; v2 = substr($0, 11, 10) + 0 }
FNR % 6 == 0 {
  head(); tau = exp(-0.1 * r)
  for (nu = v1; nu <= v2; nu += 5) {
    b = 1.191042972e-12 * nu * nu * nu / (exp(1.438776877 * nu / 300) - 1)
    printf "%8.2f%11.8f %10.4E %10.4E %10.4E %21s %10.4E %10s %10.4E %17s %7.3f%7.4f %10s %10.3f\n", nu, tau, (1 - tau) * b, 0, 0, "", 0, "", (1 - tau) * b, "", 0.1 * r, 1, "", 300
  }
  print " -9999."
}' tape5 > tape7
)");
    ::chmod(file.c_str(), 0755);
}
