/* Contact models, generic in the real type R (needs R, SQRT, FABS). */
#ifndef MODELS_H
#define MODELS_H
#include <string.h>
enum { M_LINEAR, M_KV, M_MJ, M_YELI, M_PAPI, M_HERTZ, M_HERTZDAMP, M_JANK, M_HUNT, M_FLORES, M_FRICL, M_FRICH, M_NBASE };
static const char *MODEL_NAME[] = {"linear","kv","mj","yeli","papi","hertz","hertzdamp","jank","hunt","flores","fricl","frich"};
typedef struct {
  int a, b, model, cut, hertz, smooth, phase_dep; /* phase_dep: force formula differs with sign of v */
  R gap, k, e, meff, chi, c, d;                   /* chi: factor of v/v0; c: dashpot (KV/MJ) or 2 zeta sqrt(k m) (JANK) */
} Link;
static int model_parse(const char *s, int *cut) {
  char b[64]; strncpy(b, s, 63); b[63] = 0; *cut = 0;
  size_t n = strlen(b);
  if (n > 4 && !strcmp(b + n - 4, "_cut")) { *cut = 1; b[n - 4] = 0; }
  for (int i = 0; i < M_NBASE; i++) if (!strcmp(b, MODEL_NAME[i])) return i;
  return -1;
}
static void link_setup(Link *l, int model, int cut, R klin, R khz, R e, R m1, R m2, R pi, R lne) {
  l->model = model; l->cut = cut; l->e = e; l->meff = m1 * m2 / (m1 + m2);
  l->hertz = (model == M_HERTZ || model == M_HERTZDAMP || model == M_JANK || model == M_HUNT || model == M_FLORES || model == M_FRICH);
  l->phase_dep = (model == M_MJ || model == M_JANK || model == M_FRICL || model == M_FRICH);
  l->smooth = !(l->hertz); l->k = l->hertz ? khz : klin; l->chi = 0; l->c = 0; l->d = 0;
  R e2 = e * e;
  switch (model) {
    case M_KV: l->c = 2 * (-lne / SQRT(pi * pi + lne * lne)) * SQRT(l->k * l->meff); break;
    case M_MJ: l->c = 2 * ((1 - e2) / (e * (e * (pi - 2) + 2))) * SQRT(l->k * l->meff); break;
    case M_YELI: l->chi = (R)3 / 2 * (1 - e) / e; break;
    case M_PAPI: { R al = e < (R)0.8 ? e + (R)1 / 10 : (R)1; l->chi = (R)3 / 2 * (1 - e2) / (al + e2); break; }
    case M_HERTZDAMP: l->chi = (R)3 / 4 * (1 - e2); break;
    case M_HUNT: l->chi = (R)3 / 2 * (1 - e); break;
    case M_FLORES: l->chi = (R)8 / 5 * (1 - e) / e; break;
    case M_JANK: l->c = 2 * ((R)9 / 2 * SQRT((R)5) * (1 - e2) / (e * (e * (9 * pi - 16) + 16))) * SQRT(l->k * l->meff); break;
    case M_FRICL: case M_FRICH: l->d = (1 - e2) / (1 + e2); break;
    default: break;
  }
}
/* elastic part */
static inline R f_el(const Link *l, R dl) { if (!l->hertz) return l->k * dl; return dl > 0 ? l->k * dl * SQRT(dl) : (R)0; }
/* raw force in contact (no cut). ph>0 approach, ph<0 restitution */
static inline R f_raw(const Link *l, R dl, R v, R v0, int ph) {
  R f = f_el(l, dl);
  switch (l->model) {
    case M_LINEAR: case M_HERTZ: return f;
    case M_KV: return f + l->c * v;
    case M_MJ: return ph > 0 ? f + l->c * v : f;
    case M_JANK: return ph > 0 && dl > 0 ? f + l->c * SQRT(SQRT(dl)) * v : f;
    case M_FRICL: case M_FRICH: return ph > 0 ? f * (1 + l->d) : f * (1 - l->d);
    default: return f * (1 + l->chi * v / v0);
  }
}
/* time derivative of raw force given dl' = v, v' = w */
static inline R f_dot(const Link *l, R dl, R v, R w, R v0, int ph) {
  R fd, f;
  if (!l->hertz) { fd = l->k; f = l->k * dl; }
  else { R s = dl > 0 ? SQRT(dl) : (R)0; fd = (R)3 / 2 * l->k * s; f = l->k * dl * s; if (dl <= 0) f = 0; }
  switch (l->model) {
    case M_LINEAR: case M_HERTZ: return fd * v;
    case M_KV: return fd * v + l->c * w;
    case M_MJ: return ph > 0 ? fd * v + l->c * w : fd * v;
    case M_JANK: if (ph > 0 && dl > 0) { R q = SQRT(SQRT(dl)); return fd * v + l->c * (q * w + v * v * q / (4 * dl)); } return fd * v;
    case M_FRICL: case M_FRICH: return (ph > 0 ? 1 + l->d : 1 - l->d) * fd * v;
    default: return fd * v * (1 + l->chi * v / v0) + f * l->chi * w / v0;
  }
}
#endif
