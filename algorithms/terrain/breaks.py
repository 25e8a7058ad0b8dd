from __future__ import annotations

import time
import warnings
import numpy as np

from ..points import Points
from .half_planes import Sides
from .inpaint import inpaint
from .morphology import within_square

P = dict(prune=.2, k=1.0, grow=.25, misfit=.25, brk=0.0, passes=2, least=6.0, fac=5.0, doprune=True, sus=.1, near=1.5, steep=1.5)
T = [0.,0,0,0,0]

def at_breaks(points, lowest, seeds, allowed, spacing, cells):
    from scipy import ndimage
    seeds = seeds.copy()
    reach = max(P['least'], P['fac'] * spacing)
    cell = cells.index[lowest]
    px, py, pz = points.take(lowest)
    t0=time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if P['doprune']:
            which = np.flatnonzero(seeds)
            low = np.full(cells.rows * cells.columns, np.inf)
            np.minimum.at(low, cell[which], pz[which]); low[np.isinf(low)] = np.nan
            surface = inpaint(low.reshape(cells.shape), 2)
            smooth = ndimage.uniform_filter(surface, 2 * int(np.ceil(1.5 * max(spacing, 1.0) / cells.size)) + 1, mode='nearest')
            above = pz[which] - smooth.ravel()[cell[which]]
            sus = which[above > P['sus']]
            ground = Points(px[which], py[which], pz[which])
            rise, misfit = Sides(ground, reach).rises(Points(px[sus], py[sus], pz[sus]), True)
            least = np.nanmin(rise - P['k'] * misfit, axis=1)
            seeds[sus[least > P['prune']]] = False
            T[0]+=time.perf_counter()-t0; T[2]+=len(sus); T[3]+=len(which)
        t0=time.perf_counter()
        waiting = np.flatnonzero(~seeds & allowed)
        r = int(np.ceil(P['near'] * max(spacing, 1.0) / cells.size))
        for k in range(P['passes']):
            which = np.flatnonzero(seeds)
            low = np.full(cells.rows * cells.columns, np.inf, np.float32); np.minimum.at(low, cell[which], pz[which].astype(np.float32))
            high = np.full(cells.rows * cells.columns, -np.inf, np.float32); np.maximum.at(high, cell[which], pz[which].astype(np.float32))
            low = within_square(np.minimum, low.reshape(cells.shape), r).ravel()[cell[waiting]]
            high = within_square(np.maximum, high.reshape(cells.shape), r).ravel()[cell[waiting]]
            m = P['grow'] + P['steep'] * r * cells.size
            near = waiting[(pz[waiting] >= low - m) & (pz[waiting] <= high + m)]
            ground = Points(px[which], py[which], pz[which])
            rise, misfit = Sides(ground, reach).rises(Points(px[near], py[near], pz[near]), False)
            T[4]+=len(near)
            fits = (misfit < P['misfit']) & (np.abs(rise) <= P['grow'])
            new = fits.any(axis=1)
            seeds[near[new]] = True
            waiting = np.flatnonzero(~seeds & allowed)
        T[1]+=time.perf_counter()-t0
    return seeds
