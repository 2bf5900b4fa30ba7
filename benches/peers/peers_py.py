#!/usr/bin/env python3
"""Python peers: (a) scipy solve_ivp RK45 / LSODA, the way a typical research script does it (state-based contact, no events,
max_step = record dt, np.interp ground motion, dense matrices); (b) numba RK4 fixed step, tridiagonal loop.
usage: peers_py.py CASE MODEL RK45|LSODA|numba PARAM      (PARAM: relative tolerance; for numba sub-steps of a sample)
Prints one line of JSON; wall is CPU time of the process without imports and compilation (s)."""
import json, math, os, sys, time
import numpy as np
from scipy.integrate import solve_ivp
import numba as nb
HERE = os.path.dirname(os.path.abspath(__file__))
DATA = f'{HERE}/../../tests/data'; DT = 0.005
def load(case): return json.load(open(f'{DATA}/reference_cases.json'))['cases'][case]
def mats(c):
    B = c['buildings']; m = np.concatenate([b['m'] for b in B]); n = len(m); K = np.zeros((n, n)); C = np.zeros((n, n)); o = 0
    for b in B:
        q = len(b['m']); k = np.zeros((q, q))
        for i, x in enumerate(b['k']):
            k[i, i] += x
            if i: k[i-1, i-1] += x; k[i, i-1] -= x; k[i-1, i] -= x
        K[o:o+q, o:o+q] = k; C[o:o+q, o:o+q] = b['alphaM']*np.diag(b['m'])+b['betaK']*k; o += q
    return m, K, C
def lpar(c, model):
    m = np.concatenate([b['m'] for b in c['buildings']]); L = c['links']; A = np.array([l['a'] for l in L]); B = np.array([l['b'] for l in L]); g = np.array([l['gap'] for l in L])
    me = m[A]*m[B]/(m[A]+m[B]); e = L[0]['e']; kl, kh = L[0]['k_lin'], L[0]['k_hertz']
    if model == 'linear': return A, B, g, 0, kl, 0*me
    if model == 'kv': le = math.log(e); return A, B, g, 0, kl, 2*(-le/math.sqrt(math.pi**2+le*le))*np.sqrt(kl*me)
    if model == 'hertz': return A, B, g, 1, kh, 0*me
    if model == 'hertzdamp': return A, B, g, 2, kh, 0*me+.75*(1-e*e)
    if model == 'jank': return A, B, g, 3, kh, 2*(4.5*math.sqrt(5)*(1-e*e)/(e*(e*(9*math.pi-16)+16)))*np.sqrt(kh*me)
def scipy_run(case, model, method, rtol, ag, dt):
    c = load(case); m, K, C = mats(c); n = len(m); A, B, g, ty, k, cc = lpar(c, model); tt = np.arange(len(ag))*dt; im = 1/m; v0 = np.ones(len(A)); inc = np.zeros(len(A), bool)
    def force(u, v):
        d = u[A]-u[B]-g; r = v[A]-v[B]; dp = np.maximum(d, 0.0)
        if ty == 0: f = k*dp+cc*r
        elif ty == 1: f = k*dp**1.5
        elif ty == 2:
            new = (d > 0) & ~inc; v0[new] = np.maximum(r[new], 1e-6); inc[:] = d > 0; f = k*dp**1.5*(1+cc*r/v0)
        else: f = k*dp**1.5+np.where(r > 0, cc*dp**.25*r, 0.0)
        return np.where(d > 0, f, 0.0)
    MK, MC = -K*im[:, None], -C*im[:, None]
    def f(t, y):
        u, v = y[:n], y[n:]; a = MK@u+MC@v-np.interp(t, tt, ag); F = force(u, v)
        np.subtract.at(a, A, F*im[A]); np.add.at(a, B, F*im[B]); return np.concatenate((v, a))
    t0 = time.process_time(); s = solve_ivp(f, (0, tt[-1]), np.zeros(2*n), method=method, rtol=rtol, atol=rtol*1e-2, max_step=dt); w = time.process_time()-t0
    inc[:] = False; F = np.array([force(s.y[:n, i], s.y[n:, i]) for i in range(s.y.shape[1])])
    return dict(wall=w, nfev=int(s.nfev), steps=len(s.t), peak_u=np.abs(s.y[:n]).max(1).tolist(), peak_F=F.max(0).tolist(), ok=bool(s.success))
@nb.njit(cache=True, fastmath=False)
def nb_rhs(y, ag, dy, n, first, kk, kb, al, im, A, B, g, ty, k, cc, inc, v0):
    for i in range(n):
        d = y[i] if first[i] else y[i]-y[i-1]; r = y[n+i] if first[i] else y[n+i]-y[n+i-1]
        q = kk[i]*d+kb[i]*r; dy[i] = y[n+i]; dy[n+i] = -ag-al[i]*y[n+i]-q*im[i]
        if not first[i]: dy[n+i-1] += q*im[i-1]
    for l in range(A.size):
        a, b = A[l], B[l]; d = y[a]-y[b]-g[l]
        if d > 0:
            r = y[n+a]-y[n+b]
            if ty == 0: f = k*d+cc[l]*r
            elif ty == 1: f = k*d*math.sqrt(d)
            elif ty == 2: f = k*d*math.sqrt(d)*(1+cc[l]*r/(v0[l] if inc[l] else max(r, 1e-12)))
            else: f = k*d*math.sqrt(d)+(cc[l]*math.sqrt(math.sqrt(d))*r if r > 0 else 0.0)
            dy[n+a] -= f*im[a]; dy[n+b] += f*im[b]
@nb.njit(cache=True)
def nb_rk4(ag, dt, ns, n, first, kk, kb, al, im, A, B, g, ty, k, cc):
    N = 2*n; y = np.zeros(N); k1 = np.zeros(N); k2 = np.zeros(N); k3 = np.zeros(N); k4 = np.zeros(N); z = np.zeros(N); h = dt/ns; nl = A.size
    inc = np.zeros(nl, nb.boolean); v0 = np.ones(nl); pu = np.zeros(n); pf = np.zeros(nl); cnt = np.zeros(nl)
    for s in range(ag.size-1):
        a0 = ag[s]; sl = (ag[s+1]-a0)/ns
        for j in range(ns):
            g0 = a0+sl*j; gm = g0+.5*sl; g1 = g0+sl
            nb_rhs(y, g0, k1, n, first, kk, kb, al, im, A, B, g, ty, k, cc, inc, v0)
            for i in range(N): z[i] = y[i]+.5*h*k1[i]
            nb_rhs(z, gm, k2, n, first, kk, kb, al, im, A, B, g, ty, k, cc, inc, v0)
            for i in range(N): z[i] = y[i]+.5*h*k2[i]
            nb_rhs(z, gm, k3, n, first, kk, kb, al, im, A, B, g, ty, k, cc, inc, v0)
            for i in range(N): z[i] = y[i]+h*k3[i]
            nb_rhs(z, g1, k4, n, first, kk, kb, al, im, A, B, g, ty, k, cc, inc, v0)
            for i in range(N): y[i] += h/6*(k1[i]+2*(k2[i]+k3[i])+k4[i])
            for i in range(n): pu[i] = max(pu[i], abs(y[i]))
            for l in range(nl):
                a, b = A[l], B[l]; d = y[a]-y[b]-g[l]
                if d > 0:
                    r = y[n+a]-y[n+b]
                    if not inc[l]: inc[l] = True; v0[l] = max(r, 1e-12); cnt[l] += 1
                    if ty == 0: f = k*d+cc[l]*r
                    elif ty == 1: f = k*d*math.sqrt(d)
                    elif ty == 2: f = k*d*math.sqrt(d)*(1+cc[l]*r/v0[l])
                    else: f = k*d*math.sqrt(d)+(cc[l]*math.sqrt(math.sqrt(d))*r if r > 0 else 0.0)
                    if f > pf[l]: pf[l] = f
                else: inc[l] = False
    return pu, pf, cnt
def numba_args(case, model):
    c = load(case); B = c['buildings']; m = np.concatenate([b['m'] for b in B]); kk = np.concatenate([b['k'] for b in B]); first = np.concatenate([[True]+[False]*(len(b['m'])-1) for b in B])
    kb = np.concatenate([np.array(b['k'])*b['betaK'] for b in B]); al = np.concatenate([np.full(len(b['m']), b['alphaM']) for b in B]); A, Bb, g, ty, k, cc = lpar(c, model)
    return len(m), first, kk, kb, al, 1/m, A, Bb, g, ty, k, cc
def numba_run(case, model, ns, ag, dt, reps=1):
    a = numba_args(case, model); nb_rk4(ag[:5], dt, 1, *a); best = 1e9
    for _ in range(reps): t0 = time.process_time(); pu, pf, cnt = nb_rk4(ag, dt, ns, *a); best = min(best, time.process_time()-t0)
    return dict(wall=best, peak_u=pu.tolist(), peak_F=pf.tolist(), n_impacts=cnt.tolist(), steps=ns*(len(ag)-1))
if __name__ == '__main__':
    case, model, meth, par = sys.argv[1:5]; ag = np.loadtxt(f'{DATA}/synthetic_005.csv')
    r = numba_run(case, model, int(par), ag, DT, 3) if meth == 'numba' else scipy_run(case, model, meth, float(par), ag, DT)
    print(json.dumps(dict(case=case, model=model, method=meth, par=float(par), **r)), flush=True)
