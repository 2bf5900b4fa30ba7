#!/usr/bin/env python3
"""OpenSeesPy on the reference cases: Newmark 0.5/0.25, Newton, NormDispIncr 1e-10, one analyze(N, dt) call (a C++ loop),
envelope recorders only.
usage: ops_bench.py CASE MODEL STEP [SYSTEM]      (STEP in s), or ops_bench.py --check
Prints one line of JSON; wall is CPU time of the process without imports (s)."""
import importlib.util, json, math, os, sys, tempfile, time
# The package does not find its own libblas: start again with its folder on the loader's path.
if 'POUNDING_OPS_PATH' not in os.environ:
    spec = importlib.util.find_spec('openseespylinux')
    if spec and spec.submodule_search_locations:
        lib = os.path.join(list(spec.submodule_search_locations)[0], 'lib')
        env = dict(os.environ, POUNDING_OPS_PATH='1', LD_LIBRARY_PATH=os.pathsep.join(filter(None, [lib, os.environ.get('LD_LIBRARY_PATH')])))
        os.execve(sys.executable, [sys.executable, *sys.argv], env)
import numpy as np
import openseespy.opensees as ops
HERE = os.path.dirname(os.path.abspath(__file__)); DATA = f'{HERE}/../../tests/data'; DT = 0.005
def build(case, model, ag, gdt):
    ops.wipe(); ops.model('basic', '-ndm', 1, '-ndf', 1); node = {}; nt = 1; et = 1; mt = 1; d = 0; store = []
    for bi, b in enumerate(case['buildings']):
        base = nt; ops.node(nt, 0.0); ops.fix(nt, 1); prev = nt; nt += 1; els = []; nds = []
        for m, k in zip(b['m'], b['k']):
            ops.node(nt, 0.0); ops.mass(nt, m); ops.uniaxialMaterial('Elastic', mt, k)
            ops.element('zeroLength', et, prev, nt, '-mat', mt, '-dir', 1, '-doRayleigh', 1)
            els.append(et); nds.append(nt); node[d] = nt; d += 1; prev = nt; nt += 1; et += 1; mt += 1
        ops.region(100+bi, '-ele', *els, '-rayleigh', b['alphaM'], b['betaK'], 0.0, 0.0)
    M = np.concatenate([b['m'] for b in case['buildings']]); cel = []
    for l in case['links']:
        e, g = l['e'], l['gap']; me = M[l['a']]*M[l['b']]/(M[l['a']]+M[l['b']]); le = math.log(e); z = -le/math.sqrt(math.pi**2+le*le)
        if model == 'linear': ops.uniaxialMaterial('ElasticPPGap', mt, l['k_lin'], -1e20, -g)
        elif model == 'kv': ops.uniaxialMaterial('ViscoelasticGap', mt, l['k_lin'], 2*z*math.sqrt(l['k_lin']*me), -g)
        elif model == 'hertzdamp': ops.uniaxialMaterial('HertzDamp', mt, l['k_hertz'], .75*(1-e*e), -g)
        elif model == 'hertz': ops.uniaxialMaterial('HertzDamp', mt, l['k_hertz'], 0.0, -g)
        elif model == 'hunt': ops.uniaxialMaterial('HertzDamp', mt, l['k_hertz'], 1.5*(1-e), -g)
        elif model == 'jank': ops.uniaxialMaterial('JankowskiImpact', mt, l['k_hertz'], 4.5*math.sqrt(5)*(1-e*e)/(e*(e*(9*math.pi-16)+16)), me, -g)
        elif model == 'impact':   # Muthukumar-DesRoches bilinear approximation of hertzdamp, delta_m assumed 0.01 m
            dm = 0.01; dy = 0.1*dm; keff = l['k_hertz']*math.sqrt(dm); E = l['k_hertz']*dm**2.5*(1-e*e)/2.5
            ops.uniaxialMaterial('ImpactMaterial', mt, keff+E/(.1*dm*dm), keff-E/(.9*dm*dm), -dy, -g)
        ops.element('zeroLength', et, node[l['a']], node[l['b']], '-mat', mt, '-dir', 1); cel.append(et); et += 1; mt += 1
    ops.timeSeries('Path', 1, '-dt', gdt, '-values', *[float(x) for x in ag]); ops.pattern('UniformExcitation', 1, 1, '-accel', 1)
    return node, cel
def run(case, model, dt, ag, gdt, out, system='BandGen', tol=1e-10, algo='Newton'):
    node, cel = build(case, model, ag, gdt); n = len(node); T = (len(ag)-1)*gdt; N = int(round(T/dt))
    fu, fe = f'{out}/u.txt', f'{out}/f.txt'
    ops.recorder('EnvelopeNode', '-file', fu, '-precision', 16, '-node', *[node[i] for i in range(n)], '-dof', 1, 'disp')
    ops.recorder('EnvelopeElement', '-file', fe, '-precision', 16, '-ele', *cel, 'localForce')
    ops.constraints('Plain'); ops.numberer('RCM'); ops.system(system); ops.test('NormDispIncr', tol, 25); ops.algorithm(algo)
    ops.integrator('Newmark', .5, .25); ops.analysis('Transient')
    fails = 0; t0 = time.process_time(); ok = ops.analyze(N, dt)
    while ok != 0 and ops.getTime() < T-1e-9 and fails < 5000:      # usual script recovery: 10 small steps with the initial tangent
        fails += 1; ops.algorithm('ModifiedNewton', '-initial'); ops.test('NormDispIncr', 1e-8, 200)
        ok2 = ops.analyze(10, dt/10)
        ops.algorithm(algo); ops.test('NormDispIncr', tol, 25)
        if ok2 != 0: break
        left = int(round((T-ops.getTime())/dt)); ok = ops.analyze(left, dt) if left > 0 else 0
    w = time.process_time()-t0; tend = ops.getTime(); ops.wipe()
    U = np.abs(np.loadtxt(fu)).reshape(3, -1)[2]; E = np.loadtxt(fe)
    E = E.reshape(3, -1); F = -E[0]     # min (compression) ; max row = spurious/true tension
    res = dict(dt=dt, N=N, wall=w, steps_per_s=N/w, fails=fails, t_end=tend, peak_u=U.tolist(), raw_env=E.tolist())
    nl = len(cel); q = E.shape[1]//nl; res['peak_F'] = [float(max(-E[0, i*q], 0)) for i in range(nl)]; res['max_tension'] = [float(max(E[1, i*q], 0)) for i in range(nl)]
    return res
if __name__ == '__main__':
    if sys.argv[1] == '--check': sys.exit(0)
    with open(f'{DATA}/reference_cases.json') as f: case = json.load(f)['cases'][sys.argv[1]]
    model, dt = sys.argv[2], float(sys.argv[3]); system = sys.argv[4] if len(sys.argv) > 4 else 'BandGen'; ag = np.loadtxt(f'{DATA}/synthetic_005.csv')
    with tempfile.TemporaryDirectory() as out:
        ops.logFile(f'{out}/log', '-noEcho'); r = run(case, model, dt, ag, DT, out, system); r.pop('raw_env')
        print(json.dumps(dict(case=sys.argv[1], model=model, system=system, ok=r['t_end'] > 30 - 1e-6, **r)), flush=True)
