/* Baseline integrators in C, double precision: what a tuned fixed-step loop reaches, and an event-driven prototype.
   methods: rk4 NSUB | newmark NSUB | evd TOL [-o P|T|D|M] | rk45 RTOL (adaptive DOPRI5 without event location, steps bounded by samples)
   usage: peer CASE MODEL METHOD PARAM [reps] [-t traj.bin] [-o P|T|D|M] [-s]      (-s: 1000-run sweep instead of one run)
   case files: benches/run cases FOLDER
   build: gcc -O3 -march=native peer.c -o peer -lm
   Times are of the process's CPU. wall_min is the least of reps; propagators are built in the first and kept. */
#include <math.h>
#include <time.h>
#include <stdint.h>
typedef double R;
#define SQRT sqrt
#define FABS fabs
#include "models.h"
#include "case.h"
static Case C; static Link L[MAXL]; static int n, nl; static double gap[MAXL], base_gap[MAXL];
static double mk[MAXD], mkb[MAXD], kk[MAXD], kb[MAXD], al[MAXD], im[MAXD]; static int first[MAXD];
static double pkU[MAXD], pkF[MAXL], t1[MAXL]; static long nimp[MAXL]; static long nf, nstep, nevt, ntay, ncontactsteps;
static int any_v0model, lin_model, phase_dep, cutflag;
static double now(void) { struct timespec t; clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t); return t.tv_sec + 1e-9 * t.tv_nsec; }

static inline void acc_lin(const double *restrict u, const double *restrict v, double ag, double *restrict a) {
  for (int b = 0; b < C.nb; b++) {
    int o = C.boff[b], m = C.bn[b]; double q = kk[o] * u[o] + kb[o] * v[o];
    for (int i = o; i < o + m - 1; i++) { double qn = kk[i + 1] * (u[i + 1] - u[i]) + kb[i + 1] * (v[i + 1] - v[i]); a[i] = (qn - q) * im[i] - al[i] * v[i] - ag; q = qn; }
    int i = o + m - 1; a[i] = -q * im[i] - al[i] * v[i] - ag;
  }
}
/* ---------- fixed step, state-based contact ---------- */
static int inC[MAXL]; static double v0[MAXL];
static inline double fcont(const Link *l, int i, double d, double r) {
  double z = any_v0model ? (inC[i] ? v0[i] : (r != 0 ? fabs(r) : 1e-30)) : 1.0; double f = f_raw(l, d, r, z, r > 0 ? 1 : -1); return (cutflag && f < 0) ? 0 : f;
}
static inline void rhs_fs(const double *y, double ag, double *dy) {
  const double *u = y, *v = y + n; double *a = dy + n; acc_lin(u, v, ag, a); for (int i = 0; i < n; i++) dy[i] = v[i];
  for (int l = 0; l < nl; l++) { double d = u[L[l].a] - u[L[l].b] - gap[l]; if (d > 0) { double f = fcont(&L[l], l, d, v[L[l].a] - v[L[l].b]); a[L[l].a] -= f * im[L[l].a]; a[L[l].b] += f * im[L[l].b]; } }
}
static inline void end_step(const double *y, double t) {
  for (int i = 0; i < n; i++) { double x = fabs(y[i]); pkU[i] = x > pkU[i] ? x : pkU[i]; }
  for (int l = 0; l < nl; l++) {
    double d = y[L[l].a] - y[L[l].b] - gap[l];
    if (d > 0) { double r = y[n + L[l].a] - y[n + L[l].b]; if (!inC[l]) { inC[l] = 1; v0[l] = r > 1e-12 ? r : 1e-12; nimp[l]++; if (t1[l] < 0) t1[l] = t; } double f = fcont(&L[l], l, d, r); if (f > pkF[l]) pkF[l] = f; }
    else inC[l] = 0;
  }
}
static void reset(void) { for (int i = 0; i < n; i++) pkU[i] = 0; for (int l = 0; l < nl; l++) { pkF[l] = 0; t1[l] = -1; nimp[l] = 0; inC[l] = 0; v0[l] = 1; } nf = nstep = nevt = ntay = ncontactsteps = 0; }
static void run_rk4(int ns, FILE *tf) {
  double y[2 * MAXD] = {0}, k1[2 * MAXD], k2[2 * MAXD], k3[2 * MAXD], k4[2 * MAXD], z[2 * MAXD]; int N = 2 * n; double h = C.dt / ns;
  for (int s = 0; s < C.ng - 1; s++) {
    if (tf) fwrite(y, 8, n, tf);
    double a0 = C.ag[s], sl = (C.ag[s + 1] - a0) / ns;
    for (int j = 0; j < ns; j++) {
      double g0 = a0 + sl * j, g1 = g0 + .5 * sl, g2 = g0 + sl;
      rhs_fs(y, g0, k1); for (int i = 0; i < N; i++) z[i] = y[i] + .5 * h * k1[i];
      rhs_fs(z, g1, k2); for (int i = 0; i < N; i++) z[i] = y[i] + .5 * h * k2[i];
      rhs_fs(z, g1, k3); for (int i = 0; i < N; i++) z[i] = y[i] + h * k3[i];
      rhs_fs(z, g2, k4); for (int i = 0; i < N; i++) y[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
      end_step(y, s * C.dt + (j + 1) * h);
    }
  }
  nstep = (long)(C.ng - 1) * ns; nf = 4 * nstep; if (tf) fwrite(y, 8, n, tf);
}
/* ---------- Newmark average acceleration, contact solved by Newton on the condensed flexibility ---------- */
static void run_newmark(int ns, FILE *tf) {
  double h = C.dt / ns, a0 = 4 / (h * h), a1 = 2 / h; double dg[MAXD], of[MAXD], ld[MAXD];
  for (int b = 0; b < C.nb; b++) { int o = C.boff[b], m = C.bn[b];
    for (int i = o; i < o + m; i++) { double kc = kk[i] + a1 * kb[i], kn = i + 1 < o + m ? kk[i + 1] + a1 * kb[i + 1] : 0; dg[i] = kc + kn + C.m[i] * (a0 + a1 * al[i]); of[i] = i > o ? -kc : 0; }
    for (int i = o; i < o + m; i++) { ld[i] = i > o ? of[i] / dg[i - 1] : 0; if (i > o) dg[i] -= ld[i] * of[i]; } }
  double rdg[MAXD]; for (int i = 0; i < n; i++) rdg[i] = 1 / dg[i];
#define TRISOLVE(x) do { for (int b = 0; b < C.nb; b++) { int o = C.boff[b], e = o + C.bn[b]; for (int i = o + 1; i < e; i++) x[i] -= ld[i] * x[i - 1]; x[e - 1] *= rdg[e - 1]; for (int i = e - 2; i >= o; i--) x[i] = x[i] * rdg[i] - ld[i + 1] * x[i + 1]; } } while (0)
  static double G[MAXL][MAXD]; double D[MAXL][MAXL];
  for (int l = 0; l < nl; l++) { for (int i = 0; i < n; i++) G[l][i] = 0; G[l][L[l].a] = 1; G[l][L[l].b] = -1; double *x = G[l]; TRISOLVE(x); }
  for (int i = 0; i < nl; i++) for (int j = 0; j < nl; j++) D[i][j] = G[j][L[i].a] - G[j][L[i].b];
  double y[2 * MAXD] = {0}, *u = y, *v = y + n, a[MAXD]; acc_lin(u, v, C.ag[0], a);
  double x[MAXD], w[MAXD], z[MAXD];
  for (int s = 0; s < C.ng - 1; s++) {
    if (tf) fwrite(y, 8, n, tf);
    double g0 = C.ag[s], sl = (C.ag[s + 1] - g0) / ns;
    for (int j = 0; j < ns; j++) {
      double ag = g0 + sl * (j + 1);
      for (int i = 0; i < n; i++) { double p = a0 * u[i] + 2 * a1 * v[i] + a[i], c = a1 * u[i] + v[i]; w[i] = c; x[i] = C.m[i] * (p - ag + al[i] * c); }
      for (int b = 0; b < C.nb; b++) { int o = C.boff[b], e = o + C.bn[b]; double q = kb[o] * w[o]; for (int i = o; i < e; i++) { double qn = i + 1 < e ? kb[i + 1] * (w[i + 1] - w[i]) : 0; x[i] += q - qn; q = qn; } }
      TRISOLVE(x);
      int act[MAXL], na = 0; double lam[MAXL], ds[MAXL], vs[MAXL];
      for (int l = 0; l < nl; l++) { double d = x[L[l].a] - x[L[l].b] - gap[l]; if (d > 0 || inC[l]) { act[na++] = l; } ds[l] = d; lam[l] = 0; vs[l] = a1 * (x[L[l].a] - x[L[l].b]) - (w[L[l].a] - w[L[l].b]); }
      if (na) { /* Newton on lam = F(d,v), d = ds - D lam, v = vs - a1 D lam; numerical derivative along d */
        for (int it = 0; it < 25; it++) {
          double Rr[MAXL], J[MAXL][MAXL], mx = 0; 
          for (int p = 0; p < na; p++) { int l = act[p]; double e = 0; for (int q = 0; q < na; q++) e += D[l][act[q]] * lam[act[q]]; double d = ds[l] - e, r = vs[l] - a1 * e, f = 0, fp = 0;
            if (d > 0) { f = fcont(&L[l], l, d, r); double ep = 1e-7 * d + 1e-12; fp = (fcont(&L[l], l, d + ep, r + a1 * ep) - f) / ep; }
            Rr[p] = lam[l] - f; if (fabs(Rr[p]) > mx) mx = fabs(Rr[p]); for (int q = 0; q < na; q++) J[p][q] = (p == q) + fp * D[l][act[q]]; }
          if (mx < 1e-6) break; 
          for (int p = 0; p < na; p++) for (int q = p + 1; q < na; q++) { double f = J[q][p] / J[p][p]; if (f != 0) { for (int r = p; r < na; r++) J[q][r] -= f * J[p][r]; Rr[q] -= f * Rr[p]; } }
          for (int p = na - 1; p >= 0; p--) { for (int q = p + 1; q < na; q++) Rr[p] -= J[p][q] * Rr[q]; Rr[p] /= J[p][p]; lam[act[p]] -= Rr[p]; }
          nf++;
        }
        for (int p = 0; p < na; p++) { double f = lam[act[p]]; if (f != 0) for (int i = 0; i < n; i++) x[i] -= f * G[act[p]][i]; }
      }
      for (int i = 0; i < n; i++) { double vn = a1 * x[i] - w[i]; z[i] = a0 * (x[i] - u[i]) - 2 * a1 * v[i] - a[i]; u[i] = x[i]; v[i] = vn; a[i] = z[i]; }
      end_step(y, s * C.dt + (j + 1) * h);
    }
  }
  nstep = (long)(C.ng - 1) * ns; if (tf) fwrite(y, 8, n, tf);
}
/* ---------- event-driven ---------- */
enum { OPEN, APP, RES, CUT };
static int mode[MAXL]; static double A0g, SLg; static int ncont;
static double *PB[8]; /* per building (2m) x (2m+2), column-major padded */ static int ldp[8];
static double cdt = 0; static char open_kind = 'P'; static double etol;
static inline double force_of(int l, double d, double r) { return f_raw(&L[l], d, r, v0[l], mode[l] == APP ? 1 : -1); }
static inline void rhs_ev(double tau, const double *y, double *dy) {
  const double *u = y, *v = y + n; double *a = dy + n; acc_lin(u, v, A0g + SLg * tau, a); for (int i = 0; i < n; i++) dy[i] = v[i];
  if (ncont) for (int l = 0; l < nl; l++) if (mode[l] == APP || mode[l] == RES) { double f = force_of(l, u[L[l].a] - u[L[l].b] - gap[l], v[L[l].a] - v[L[l].b]); a[L[l].a] -= f * im[L[l].a]; a[L[l].b] += f * im[L[l].b]; }
  nf++;
}
/* homogeneous linear part incl. linear contact (no forcing, no gap) for Taylor terms >= 2 */
static inline void lin_hom(const double *w, double *o) {
  const double *u = w, *v = w + n; double *a = o + n; acc_lin(u, v, 0, a); for (int i = 0; i < n; i++) o[i] = v[i];
  if (ncont) for (int l = 0; l < nl; l++) if (mode[l] == APP || mode[l] == RES) { double d = u[L[l].a] - u[L[l].b], r = v[L[l].a] - v[L[l].b], f = L[l].k * d + ((mode[l] == APP || L[l].model == M_KV) ? L[l].c * r : 0); a[L[l].a] -= f * im[L[l].a]; a[L[l].b] += f * im[L[l].b]; }
}
static void taylor(double tau, const double *y, double h, double *yo) {
  double w[2 * MAXD], o[2 * MAXD]; int N = 2 * n; ntay++;
  rhs_ev(tau, y, w); for (int i = 0; i < N; i++) { w[i] *= h; yo[i] = y[i] + w[i]; }
  for (int k = 2; k < 60; k++) {
    lin_hom(w, o); if (k == 2) for (int i = 0; i < n; i++) o[n + i] -= SLg * h; double c = h / k, mu = 0, mv = 0;
    for (int i = 0; i < n; i++) { w[i] = o[i] * c; w[n + i] = o[n + i] * c; yo[i] += w[i]; yo[n + i] += w[n + i]; double p = fabs(w[i]), q = fabs(w[n + i]); mu = p > mu ? p : mu; mv = q > mv ? q : mv; }
    if (k > 3 && mu < 1e-18 && mv < 1e-17) break;
  }
}
/* dense one-sample propagator for each building by Taylor columns with 2^s squaring-free substeps */
static void build_P(void) {
  int sub = 8; int snb = C.nb; (void)snb; double h = C.dt / sub; int save = ncont; ncont = 0;
  for (int b = 0; b < C.nb; b++) {
    int m = C.bn[b], o = C.boff[b], ld = (2 * m + 7) & ~7; ldp[b] = ld; if (!PB[b]) PB[b] = aligned_alloc(64, sizeof(double) * ld * (2 * m + 2)); memset(PB[b], 0, sizeof(double) * ld * (2 * m + 2));
    for (int c = 0; c < 2 * m + 2; c++) {
      double y[2 * MAXD] = {0}, z[2 * MAXD]; double ga = 0, gb = 0;
      if (c < m) y[o + c] = 1; else if (c < 2 * m) y[n + o + c - m] = 1; else if (c == 2 * m) ga = 1; else gb = 1;
      SLg = (gb - ga) / C.dt; A0g = ga;
      for (int s = 0; s < sub; s++) { taylor(s * h, y, h, z); memcpy(y, z, sizeof(double) * 2 * n); }
      for (int i = 0; i < m; i++) { PB[b][c * ld + i] = y[o + i]; PB[b][c * ld + m + i] = y[n + o + i]; }
    }
  }
  ncont = save; cdt = C.dt;
}
static inline void open_step(const double *restrict y, double g0, double g1, double *restrict yo) {
  for (int b = 0; b < C.nb; b++) {
    int m = C.bn[b], o = C.boff[b], ld = ldp[b]; double t[2 * MAXD + 8] __attribute__((aligned(64))); const double *restrict P = __builtin_assume_aligned(PB[b], 64);
    const double *pa = P + 2 * m * ld, *pb = pa + ld; for (int i = 0; i < ld; i++) t[i] = pa[i] * g0 + pb[i] * g1;
    for (int c = 0; c < m; c++) { double x = y[o + c], z = y[n + o + c]; const double *p = P + c * ld, *q = P + (c + m) * ld; for (int i = 0; i < ld; i++) t[i] += p[i] * x + q[i] * z; }
    for (int i = 0; i < m; i++) { yo[o + i] = t[i]; yo[n + o + i] = t[m + i]; }
  }
}
/* modal free flight (proportional damping): exact SDOF recurrences at the sample step, physical state by back-transformation */
static double PHI[8][MAXD * MAXD], MA[4][MAXD], MB[4][MAXD], GAM[MAXD], mq[MAXD], mv[MAXD]; static int modal_valid; static double mdt;
static void build_modal(void) {
  for (int b = 0; b < C.nb; b++) {
    int m = C.bn[b], o = C.boff[b]; double A[MAXD][MAXD], V[MAXD][MAXD];
    for (int i = 0; i < m; i++) for (int j = 0; j < m; j++) { double k = 0; if (i == j) k = kk[o + i] + (i + 1 < m ? kk[o + i + 1] : 0); else if (j == i + 1) k = -kk[o + j]; else if (i == j + 1) k = -kk[o + i]; A[i][j] = k / sqrt(C.m[o + i] * C.m[o + j]); V[i][j] = i == j; }
    for (int sw = 0; sw < 60; sw++) { double off = 0; for (int p = 0; p < m; p++) for (int q = p + 1; q < m; q++) { off += A[p][q] * A[p][q]; if (fabs(A[p][q]) < 1e-300) continue; double th = (A[q][q] - A[p][p]) / (2 * A[p][q]), t = (th >= 0 ? 1 : -1) / (fabs(th) + sqrt(th * th + 1)), c = 1 / sqrt(t * t + 1), sn = t * c;
      for (int i = 0; i < m; i++) { double x = A[i][p], z = A[i][q]; A[i][p] = c * x - sn * z; A[i][q] = sn * x + c * z; } for (int i = 0; i < m; i++) { double x = A[p][i], z = A[q][i]; A[p][i] = c * x - sn * z; A[q][i] = sn * x + c * z; } for (int i = 0; i < m; i++) { double x = V[i][p], z = V[i][q]; V[i][p] = c * x - sn * z; V[i][q] = sn * x + c * z; } } if (off < 1e-20) break; }
    for (int j = 0; j < m; j++) { double w2 = A[j][j], c2 = al[o] + kb[o] / kk[o] * w2, g = 0; for (int i = 0; i < m; i++) { PHI[b][j * m + i] = V[i][j] / sqrt(C.m[o + i]); g += V[i][j] * sqrt(C.m[o + i]); } GAM[o + j] = g;
      for (int col = 0; col < 4; col++) { double q = col == 0, v = col == 1, fa = col == 2, fb = col == 3; int N = 64; double h = C.dt / N;
        for (int st = 0; st < N; st++) { double f0 = -(fa + (fb - fa) * st / N), f1 = -(fb - fa) / C.dt; double tq = q, tv = v, rq = q, rv = v; for (int k = 1; k < 30; k++) { double nq = tv * h / k, nv = (-w2 * tq - c2 * tv + (k == 1 ? f0 : k == 2 ? f1 * h : 0)) * h / k; tq = nq; tv = nv; rq += tq; rv += tv; } q = rq; v = rv; }
        double sc = col < 2 ? 1 : g; if (col < 2) { MA[col][o + j] = q; MA[col + 2][o + j] = v; } else { MB[col - 2][o + j] = q * sc; MB[col][o + j] = v * sc; } } }
  }
  mdt = C.dt;
}
static inline void modal_step(const double *restrict y, double g0, double g1, double *restrict yo) {
  if (!modal_valid) { for (int b = 0; b < C.nb; b++) { int m = C.bn[b], o = C.boff[b]; for (int j = 0; j < m; j++) { double q = 0, v = 0; const double *p = PHI[b] + j * m; for (int i = 0; i < m; i++) { double w = p[i] * C.m[o + i]; q += w * y[o + i]; v += w * y[n + o + i]; } mq[o + j] = q; mv[o + j] = v; } } modal_valid = 1; }
  for (int j = 0; j < n; j++) { double q = mq[j], v = mv[j]; mq[j] = MA[0][j] * q + MA[1][j] * v + MB[0][j] * g0 + MB[1][j] * g1; mv[j] = MA[2][j] * q + MA[3][j] * v + MB[2][j] * g0 + MB[3][j] * g1; }
  for (int b = 0; b < C.nb; b++) { int m = C.bn[b], o = C.boff[b]; double u[MAXD] = {0}, w[MAXD] = {0}; for (int j = 0; j < m; j++) { double q = mq[o + j], v = mv[o + j]; const double *restrict p = PHI[b] + j * m; for (int i = 0; i < m; i++) { u[i] += p[i] * q; w[i] += p[i] * v; } } for (int i = 0; i < m; i++) { yo[o + i] = u[i]; yo[n + o + i] = w[i]; } }
}
/* Dormand-Prince 5(4) */
static double dp_err;
static void dp5(double tau, const double *y, double h, double *yo) {
  static double k1[2 * MAXD], k2[2 * MAXD], k3[2 * MAXD], k4[2 * MAXD], k5[2 * MAXD], k6[2 * MAXD], k7[2 * MAXD], z[2 * MAXD]; int N = 2 * n;
  rhs_ev(tau, y, k1); for (int i = 0; i < N; i++) z[i] = y[i] + h * .2 * k1[i];
  rhs_ev(tau + .2 * h, z, k2); for (int i = 0; i < N; i++) z[i] = y[i] + h * (3. / 40 * k1[i] + 9. / 40 * k2[i]);
  rhs_ev(tau + .3 * h, z, k3); for (int i = 0; i < N; i++) z[i] = y[i] + h * (44. / 45 * k1[i] - 56. / 15 * k2[i] + 32. / 9 * k3[i]);
  rhs_ev(tau + .8 * h, z, k4); for (int i = 0; i < N; i++) z[i] = y[i] + h * (19372. / 6561 * k1[i] - 25360. / 2187 * k2[i] + 64448. / 6561 * k3[i] - 212. / 729 * k4[i]);
  rhs_ev(tau + 8. / 9 * h, z, k5); for (int i = 0; i < N; i++) z[i] = y[i] + h * (9017. / 3168 * k1[i] - 355. / 33 * k2[i] + 46732. / 5247 * k3[i] + 49. / 176 * k4[i] - 5103. / 18656 * k5[i]);
  rhs_ev(tau + h, z, k6); for (int i = 0; i < N; i++) yo[i] = y[i] + h * (35. / 384 * k1[i] + 500. / 1113 * k3[i] + 125. / 192 * k4[i] - 2187. / 6784 * k5[i] + 11. / 84 * k6[i]);
  rhs_ev(tau + h, yo, k7); double e = 0;
  for (int i = 0; i < N; i++) { double q = h * (71. / 57600 * k1[i] - 71. / 16695 * k3[i] + 71. / 1920 * k4[i] - 17253. / 339200 * k5[i] + 22. / 525 * k6[i] - 1. / 40 * k7[i]); double sc = (i < n ? 1e-2 : 1e-1) + fabs(y[i]); q = fabs(q) / sc; e = q > e ? q : e; }
  dp_err = e;
}
static inline double herm3(double s, double H, double f0, double d0, double f1, double d1) { double s2 = s * s, s3 = s2 * s; return f0 * (2 * s3 - 3 * s2 + 1) + f1 * (3 * s2 - 2 * s3) + H * (d0 * (s3 - 2 * s2 + s) + d1 * (s3 - s2)); }
static int use_rk; /* this propagation uses dp5 (nonlinear contact active) */
static inline void prop(double tau, const double *y, double h, double *yo) { if (use_rk) dp5(tau, y, h, yo); else taylor(tau, y, h, yo); }
enum { K_ON, K_OFF, K_V, K_CUT, K_UNCUT };
static void gfun(int kind, int l, const double *y, double tau, double *g, double *gd) {
  double d = y[L[l].a] - y[L[l].b] - gap[l], r = y[n + L[l].a] - y[n + L[l].b];
  if (kind == K_ON || kind == K_OFF) { *g = d; *gd = r; return; }
  double dy[2 * MAXD]; rhs_ev(tau, y, dy); double w = dy[n + L[l].a] - dy[n + L[l].b];
  if (kind == K_V) { *g = r; *gd = w; } else { int ph = 1; *g = f_raw(&L[l], d, r, v0[l], ph); *gd = f_dot(&L[l], d, r, w, v0[l], ph); }
}
static double locate(int kind, int l, double tau, const double *y, double lo, double hi, double glo, double ghi, double h, double *yo) {
  int up = ghi > glo; double g, gd;
  for (int it = 0; it < 60; it++) {
    if (!(h > lo && h < hi)) h = .5 * (lo + hi);
    prop(tau, y, h, yo); gfun(kind, l, yo, tau + h, &g, &gd);
    if ((g > 0) == up) hi = h; else lo = h;
    double hn = h - g / gd; if (fabs(hn - h) < 1e-15 || hi - lo < 1e-16) return h; h = hn;
  }
  return h;
}
static void peaks_u(double tau, const double *y, double h, const double *y1) {
  for (int i = 0; i < n; i++) { double x = fabs(y1[i]); pkU[i] = x > pkU[i] ? x : pkU[i]; }
  int flag = 0; for (int i = 0; i < n; i++) { double bd = (fabs(y[i]) > fabs(y1[i]) ? fabs(y[i]) : fabs(y1[i])) + .5 * h * (fabs(y[n + i]) + fabs(y1[n + i])); flag |= (y[n + i] * y1[n + i] < 0) & (bd > pkU[i]); }
  if (!flag) return;
  for (int i = 0; i < n; i++) if (y[n + i] * y1[n + i] < 0) {
    double s = y[n + i] / (y[n + i] - y1[n + i]); double e = fabs(herm3(s, h, y[i], y[n + i], y1[i], y1[n + i]));
    if (e > pkU[i] * (1 - 1e-6)) { double z[2 * MAXD], dd[2 * MAXD]; double hh = s * h; prop(tau, y, hh, z); if (open_kind == 'P' || !use_rk || 1) { rhs_ev(tau + hh, z, dd); hh -= z[n + i] / dd[n + i]; if (hh > 0 && hh < h) { double e2 = fabs(z[i] - .5 * z[n + i] * z[n + i] / dd[n + i]); if (e2 > pkU[i]) pkU[i] = e2; } else if (fabs(z[i]) > pkU[i]) pkU[i] = fabs(z[i]); } }
  }
}
static void peaks_F(double tau, const double *y, double h, const double *y1) {
  double d0[2 * MAXD], d1[2 * MAXD]; int got = 0;
  for (int l = 0; l < nl; l++) if (mode[l] == APP || mode[l] == RES) {
    int ph = mode[l] == APP ? 1 : -1; double da = y[L[l].a] - y[L[l].b] - gap[l], ra = y[n + L[l].a] - y[n + L[l].b], db = y1[L[l].a] - y1[L[l].b] - gap[l], rb = y1[n + L[l].a] - y1[n + L[l].b];
    double fa = f_raw(&L[l], da, ra, v0[l], ph), fb = f_raw(&L[l], db, rb, v0[l], ph); if (fa > pkF[l]) pkF[l] = fa; if (fb > pkF[l]) pkF[l] = fb;
    if ((fa > fb ? fa : fb) < .6 * pkF[l]) continue;
    if (!got) { rhs_ev(tau, y, d0); rhs_ev(tau + h, y1, d1); got = 1; }
    double ga = f_dot(&L[l], da, ra, d0[n + L[l].a] - d0[n + L[l].b], v0[l], ph), gb = f_dot(&L[l], db, rb, d1[n + L[l].a] - d1[n + L[l].b], v0[l], ph);
    if (ga > 0 && gb < 0) { double s = ga / (ga - gb), e = herm3(s, h, fa, ga, fb, gb);
      if (e > pkF[l] * .999) { double lo = 0, hi = h, gl = ga, gh = gb, hh = s * h, z[2 * MAXD], dz[2 * MAXD];
        for (int it = 0; it < 6; it++) { prop(tau, y, hh, z); rhs_ev(tau + hh, z, dz); double dd = z[L[l].a] - z[L[l].b] - gap[l], r = z[n + L[l].a] - z[n + L[l].b], f = f_raw(&L[l], dd, r, v0[l], ph), g = f_dot(&L[l], dd, r, dz[n + L[l].a] - dz[n + L[l].b], v0[l], ph);
          if (f > pkF[l]) pkF[l] = f; if (g > 0) { lo = hh; gl = g; } else { hi = hh; gh = g; } double hn = lo + gl / (gl - gh) * (hi - lo); if (fabs(hn - hh) < 1e-7 * h + 1e-12) break; hh = hn; } } }
  }
}
/* earliest event in (0,h] for the step y->y1; returns link or -1 */
static int find_event(double tau, const double *y, double h, const double *y1, double *he, double *ye, int *kind) {
  int best = -1; double hb = h * (1 + 1e-15), z[2 * MAXD];
  for (int l = 0; l < nl; l++) {
    int a = L[l].a, b = L[l].b; double d1 = y1[a] - y1[b] - gap[l], r1 = y1[n + a] - y1[n + b];
    if (mode[l] == OPEN) {
      double r0 = y[n + a] - y[n + b];
      if (d1 <= 0 && !(r0 > 0 && r1 < 0)) continue;
      double d0 = y[a] - y[b] - gap[l];
      if (d1 <= 0) { /* possible interior touch */
        double s = r0 / (r0 - r1), e = herm3(s, h, d0, r0, d1, r1); if (e < -1e-3 * h * (fabs(r0) + fabs(r1))) continue;
        double lo = 0, hi = h, hh = s * h, g, gd; for (int it = 0; it < 8; it++) { prop(tau, y, hh, z); gfun(K_V, l, z, tau + hh, &g, &gd); if (g > 0) lo = hh; else hi = hh; double hn = hh - g / gd; if (!(hn > lo && hn < hi)) hn = .5 * (lo + hi); if (fabs(hn - hh) < 1e-12) break; hh = hn; }
        double dm = z[a] - z[b] - gap[l]; if (dm <= 0) continue;
        double hr = locate(K_ON, l, tau, y, 0, hh, d0, dm, hh * .5, z); if (hr < hb) { hb = hr; best = l; *kind = K_ON; memcpy(ye, z, sizeof(double) * 2 * n); }
        continue;
      }
      /* bracketed root: start from secant on cubic Hermite (two Newton steps) */
      double s = d0 < 0 ? d0 / (d0 - d1) : 0; for (int q = 0; q < 3; q++) { double f = herm3(s, h, d0, r0, d1, r1), e = 1e-4, fp = (herm3(s + e, h, d0, r0, d1, r1) - f) / e; double sn = s - f / fp; if (!(sn > 0 && sn < 1)) break; s = sn; }
      if (s * h > hb) { double f = d0; (void)f; }
      double hr;
      if (r0 < 0 && r1 > 0) { /* opens (further) first: search after the minimum, so a fresh separation cannot re-close at once */
        double lo = 0, hi = h, hh = h * r0 / (r0 - r1), g, gd; for (int it = 0; it < 12; it++) { prop(tau, y, hh, z); gfun(K_V, l, z, tau + hh, &g, &gd); if (g < 0) lo = hh; else hi = hh; double hn = hh - g / gd; if (!(hn > lo && hn < hi)) hn = .5 * (lo + hi); if (fabs(hn - hh) < 1e-14) break; hh = hn; }
        double dm = z[a] - z[b] - gap[l]; if (dm >= 0) { hr = hh; } else hr = locate(K_ON, l, tau, y, hh, h, dm, d1, .5 * (hh + h), z);
      } else { hr = d0 >= 0 ? 0 : locate(K_ON, l, tau, y, 0, h, d0, d1, s * h, z); if (d0 >= 0) memcpy(z, y, sizeof(double) * 2 * n); }
      if (hr < hb) { hb = hr; best = l; *kind = K_ON; memcpy(ye, z, sizeof(double) * 2 * n); }
    } else {
      double d0 = y[a] - y[b] - gap[l], r0 = y[n + a] - y[n + b];
      if (d1 >= 0 && r0 < 0 && r1 > 0) { /* possible brief separation inside the step */
        double sm = r0 / (r0 - r1), em = herm3(sm, h, d0, r0, d1, r1);
        if (em < 1e-3 * h * (fabs(r0) + fabs(r1))) {
          double lo = 0, hi = h, hh = sm * h, g, gd; for (int it = 0; it < 8; it++) { prop(tau, y, hh, z); gfun(K_V, l, z, tau + hh, &g, &gd); if (g < 0) lo = hh; else hi = hh; double hn = hh - g / gd; if (!(hn > lo && hn < hi)) hn = .5 * (lo + hi); if (fabs(hn - hh) < 1e-12) break; hh = hn; }
          double dm = z[a] - z[b] - gap[l];
          if (dm < 0) { double hr = locate(K_OFF, l, tau, y, 0, hh, d0, dm, hh * .5, z); if (hr < hb) { hb = hr; best = l; *kind = K_OFF; memcpy(ye, z, sizeof(double) * 2 * n); } }
        }
      }
      if (d1 < 0) { double s = d0 > 0 ? d0 / (d0 - d1) : .5; double hr = locate(K_OFF, l, tau, y, 0, h, d0, d1, s * h, z); if (hr < hb) { hb = hr; best = l; *kind = K_OFF; memcpy(ye, z, sizeof(double) * 2 * n); } }
      if (phase_dep && mode[l] != CUT && ((mode[l] == APP) == (r1 <= 0))) { double s = r0 / (r0 - r1); double hr = locate(K_V, l, tau, y, 0, h, r0, r1, (s > 0 && s < 1 ? s : .5) * h, z); if (hr < hb) { hb = hr; best = l; *kind = K_V; memcpy(ye, z, sizeof(double) * 2 * n); } }
      if (cutflag) {
        double f1 = f_raw(&L[l], d1, r1, v0[l], 1), f0 = f_raw(&L[l], d0, r0, v0[l], 1);
        if (mode[l] == APP && f1 < 0) { double hr = locate(K_CUT, l, tau, y, 0, h, f0, f1, f0 > 0 ? f0 / (f0 - f1) * h : h * .5, z); if (hr < hb) { hb = hr; best = l; *kind = K_CUT; memcpy(ye, z, sizeof(double) * 2 * n); } }
        if (mode[l] == CUT && f1 > 0 && d1 >= 0) { double hr = locate(K_UNCUT, l, tau, y, 0, h, f0, f1, f0 < 0 ? f0 / (f0 - f1) * h : h * .5, z); if (hr < hb) { hb = hr; best = l; *kind = K_UNCUT; memcpy(ye, z, sizeof(double) * 2 * n); } }
      }
    }
  }
  *he = hb; return best;
}
static double hcmax; static int dbg;
static void run_evd(double tol, FILE *tf) {
  etol = tol; double y[2 * MAXD] = {0}, y1[2 * MAXD], ye[2 * MAXD]; for (int l = 0; l < nl; l++) mode[l] = OPEN; ncont = 0;
  if (open_kind == 'P' && cdt != C.dt) build_P(); if (open_kind == 'M') { if (mdt != C.dt) build_modal(); modal_valid = 0; }
  /* contact substep bound for the linear path */
  double wm = 0; for (int l = 0; l < nl; l++) { double w = sqrt(L[l].k / L[l].meff); if (w > wm) wm = w; } { const char *e_ = getenv("HCF"); double hf = e_ ? atof(e_) : 0.8; hcmax = lin_model ? hf / wm : 1e9; }
  int nsub = (int)ceil(C.dt / hcmax); if (nsub < 1) nsub = 1; double hrk = 1e-4;
  double dt = C.dt;
  for (int s = 0; s < C.ng - 1; s++) {
    if (tf) fwrite(y, 8, n, tf);
    A0g = C.ag[s]; SLg = (C.ag[s + 1] - C.ag[s]) / dt; double tau = 0;
    while (tau < dt) {
      double h; int last = 0; use_rk = (ncont && !lin_model) || open_kind == 'D';
      if (!ncont && open_kind != 'D') {
        h = dt - tau; last = 1; if (tau == 0 && open_kind == 'P') open_step(y, C.ag[s], C.ag[s + 1], y1); else if (tau == 0 && open_kind == 'M') modal_step(y, C.ag[s], C.ag[s + 1], y1); else taylor(tau, y, h, y1); nstep++;
      } else if (!use_rk) { h = dt / nsub; if (h >= (dt - tau) * (1 - 1e-9)) { h = dt - tau; last = 1; } else if (h > (dt - tau) * .5) h = .5 * (dt - tau); taylor(tau, y, h, y1); nstep++; ncontactsteps++; }
      else {
        h = hrk; last = 0; if (h >= (dt - tau) * (1 - 1e-9)) { h = dt - tau; last = 1; } else if (h > .5 * (dt - tau)) h = .5 * (dt - tau);
        for (;;) { dp5(tau, y, h, y1); double e = dp_err / tol; nstep++; ncontactsteps++; if (e <= 1 || h < 1e-12) { double f = e > 0 ? .9 * pow(e, -.2) : 5; if (f > 5) f = 5; if (f < .3) f = .3; double hn = h * f; if (!last || hn < hrk) hrk = hn; break; } double f = .9 * pow(e, -.2); if (f < .1) f = .1; h *= f; hrk = h; last = 0; }
      }
      double he; int kind, l = find_event(tau, y, h, y1, &he, ye, &kind);
      const double *yn = y1; if (l >= 0) { yn = ye; h = he; last = 0; nevt++; }
      peaks_u(tau, y, h, yn); if (ncont) peaks_F(tau, y, h, yn);
      if (l >= 0 || ncont || tau > 0) modal_valid = 0;
      memcpy(y, yn, sizeof(double) * 2 * n); tau = last ? dt : tau + h;
      if (l >= 0) {
        double r = y[n + L[l].a] - y[n + L[l].b];
        if (dbg) printf("%.9f %d %s\n", s * dt + tau, l, kind == K_ON ? "on" : kind == K_OFF ? "off" : kind == K_V ? (mode[l] == APP ? "vdn" : "vup") : "cut"); switch (kind) {
          case K_ON: mode[l] = APP; v0[l] = r; nimp[l]++; if (t1[l] < 0) t1[l] = s * dt + tau; ncont++; { double f = f_raw(&L[l], 0, r, r, 1); if (f > pkF[l]) pkF[l] = f; } break;
          case K_OFF: mode[l] = OPEN; ncont--; break;
          case K_V: mode[l] = mode[l] == APP ? RES : APP; break;
          case K_CUT: mode[l] = CUT; break;
          case K_UNCUT: mode[l] = APP; break;
        }
        if (!lin_model) hrk = kind == K_ON ? 3e-5 : hrk;
      }
    }
  }
  if (tf) fwrite(y, 8, n, tf);
}
/* ---------- adaptive DOPRI5, state-based contact, steps bounded by samples (a careful script without events) ---------- */
static void run_rk45(double rtol, FILE *tf) {
  double y[2 * MAXD] = {0}, z[2 * MAXD], k[7][2 * MAXD]; int N = 2 * n; double h = 1e-4, dt = C.dt;
  for (int s = 0; s < C.ng - 1; s++) {
    if (tf) fwrite(y, 8, n, tf); double a0 = C.ag[s], sl = (C.ag[s + 1] - a0) / dt, tau = 0;
    while (tau < dt) {
      int last = 0; double hh = h; if (hh >= (dt - tau) * (1 - 1e-9)) { hh = dt - tau; last = 1; }
#define ST(j, c, expr) do { for (int i = 0; i < N; i++) z[i] = y[i] + hh * (expr); rhs_fs(z, a0 + sl * (tau + (c) * hh), k[j]); } while (0)
      rhs_fs(y, a0 + sl * tau, k[0]);
      ST(1, .2, .2 * k[0][i]); ST(2, .3, 3. / 40 * k[0][i] + 9. / 40 * k[1][i]); ST(3, .8, 44. / 45 * k[0][i] - 56. / 15 * k[1][i] + 32. / 9 * k[2][i]);
      ST(4, 8. / 9, 19372. / 6561 * k[0][i] - 25360. / 2187 * k[1][i] + 64448. / 6561 * k[2][i] - 212. / 729 * k[3][i]);
      ST(5, 1, 9017. / 3168 * k[0][i] - 355. / 33 * k[1][i] + 46732. / 5247 * k[2][i] + 49. / 176 * k[3][i] - 5103. / 18656 * k[4][i]);
      ST(6, 1, 35. / 384 * k[0][i] + 500. / 1113 * k[2][i] + 125. / 192 * k[3][i] - 2187. / 6784 * k[4][i] + 11. / 84 * k[5][i]);
      double e = 0; for (int i = 0; i < N; i++) { double q = hh * (71. / 57600 * k[0][i] - 71. / 16695 * k[2][i] + 71. / 1920 * k[3][i] - 17253. / 339200 * k[4][i] + 22. / 525 * k[5][i] - 1. / 40 * k[6][i]); q = fabs(q) / (rtol * ((i < n ? 1e-2 : 1e-1) + fabs(y[i]))); e = q > e ? q : e; }
      nstep++; nf += 7; double f = e > 0 ? .9 * pow(e, -.2) : 5; if (f > 5) f = 5; if (f < .1) f = .1;
      if (e <= 1 || hh < 1e-10) { memcpy(y, z, sizeof(double) * N); tau = last ? dt : tau + hh; end_step(y, s * dt + tau); if (!last || f < 1) h = hh * f; else if (hh * f > h) h = hh * f; } else h = hh * f;
    }
  }
  if (tf) fwrite(y, 8, n, tf);
}
static void setup(double kf) {
  for (int l = 0; l < nl; l++) { int cut, m = L[l].model; cut = cutflag; L[l].a = C.la[l]; L[l].b = C.lb[l]; double e = C.le[l]; link_setup(&L[l], m, cut, C.lkl[l] * kf, C.lkh[l] * kf, e, C.m[C.la[l]], C.m[C.lb[l]], M_PI, log(e)); }
}
int main(int argc, char **argv) {
  if (argc < 5) return 2; case_read(&C, argv[1]); n = C.n; nl = C.nl; int cut, m = model_parse(argv[2], &cut); cutflag = cut; const char *meth = argv[3]; double par = atof(argv[4]);
  dbg = getenv("EVLOG") != NULL; int reps = argc > 5 ? atoi(argv[5]) : 1, sweep = 0; const char *tr = NULL; for (int i = 6; i < argc; i++) { if (!strcmp(argv[i], "-t")) tr = argv[++i]; else if (!strcmp(argv[i], "-o")) open_kind = argv[++i][0]; else if (!strcmp(argv[i], "-s")) sweep = 1; }
  for (int l = 0; l < nl; l++) { L[l].model = m; gap[l] = base_gap[l] = C.lgap[l]; } setup(1);
  for (int i = 0; i < n; i++) { kk[i] = C.k[i]; kb[i] = C.k[i] * C.beta[C.bld[i]]; al[i] = C.alpha[C.bld[i]]; im[i] = C.im[i]; }
  any_v0model = (m == M_YELI || m == M_PAPI || m == M_HERTZDAMP || m == M_HUNT || m == M_FLORES); lin_model = (m == M_LINEAR || m == M_KV || m == M_MJ); phase_dep = L[0].phase_dep;
#define GO(tf) do { reset(); if (!strcmp(meth, "rk4")) run_rk4((int)par, tf); else if (!strcmp(meth, "newmark")) run_newmark((int)par, tf); else if (!strcmp(meth, "evd")) run_evd(par, tf); else if (!strcmp(meth, "rk45")) run_rk45(par, tf); else return 2; } while (0)
  if (sweep) { double c0 = now(), sum = 0; for (int ig = 0; ig < 40; ig++) for (int ik = 0; ik < 25; ik++) { double gf = 0.25 + 0.05 * ig, kf = pow(10, -0.5 + ik / 24.0); for (int l = 0; l < nl; l++) gap[l] = base_gap[l] * gf; setup(kf); GO(NULL); double mx = 0; for (int l = 0; l < nl; l++) if (pkF[l] > mx) mx = pkF[l]; sum += mx; }
    printf("{\"case\":\"%s\",\"model\":\"%s\",\"method\":\"%s\",\"par\":%g,\"open\":\"%c\",\"sweep_runs\":1000,\"wall\":%.4f,\"sumF\":%.10g}\n", argv[1], argv[2], meth, par, open_kind, now() - c0, sum); return 0; }
  double best = 1e30, tot = 0; for (int r = 0; r < reps; r++) { double c0 = now(); GO(NULL); double w = now() - c0; tot += w; if (w < best) best = w; }
  if (tr) { FILE *f = fopen(tr, "wb"); GO(f); fclose(f); }
  printf("{\"model\":\"%s\",\"method\":\"%s\",\"par\":%g,\"open\":\"%c\",\"wall_min\":%.7f,\"wall_mean\":%.7f,\"nstep\":%ld,\"nf\":%ld,\"nevt\":%ld,\"ntay\":%ld,\"ncs\":%ld,\"peak_u\":[", argv[2], meth, par, open_kind, best, tot / reps, nstep, nf, nevt, ntay, ncontactsteps);
  for (int i = 0; i < n; i++) printf("%s%.17g", i ? "," : "", pkU[i]); printf("],\"peak_F\":["); for (int l = 0; l < nl; l++) printf("%s%.17g", l ? "," : "", pkF[l]); printf("],\"t_first\":["); for (int l = 0; l < nl; l++) printf("%s%.17g", l ? "," : "", t1[l]); printf("],\"n_impacts\":["); for (int l = 0; l < nl; l++) printf("%s%ld", l ? "," : "", nimp[l]); printf("]}\n");
  return 0;
}
