from __future__ import annotations
import numpy as np
from .inpaint import inpaint
from .gradient import gradient, length

F = dict(sig=1.5, up=.18, down=.6, k=0.0, c=1.4, cd=1.4, kd=0., rs=3.0, cap=9.0, how='mean', correct=True, most=1.5)

def final_limits(points, vertices, cells, spacing, par):
    from scipy import ndimage
    g = lambda a, s: ndimage.gaussian_filter(a, s, mode="nearest")
    x, y, z = points.take(vertices)
    cell = cells.index[vertices]
    n = cells.rows * cells.columns
    low = np.full(n, np.inf); np.minimum.at(low, cell, z); low[np.isinf(low)] = np.nan
    S = inpaint(low.reshape(cells.shape))
    sig = F['sig'] * max(1.0, spacing / cells.size / 1.0) if F.get('scale') else F['sig']
    if F['correct']:
        for _ in range(2):
            smooth = g(S, sig)
            gy, gx = gradient(smooth, cells.size)
            st = np.maximum(length(gy, gx), 1e-9); f = np.minimum(1.0, F['most'] / st); gx, gy = gx * f, gy * f
            row, col = np.divmod(cell, cells.columns)
            dx = (col + cells.first_column + .5) * cells.size - x
            dy = (row + cells.first_row + .5) * cells.size - y
            zc = z + gx.ravel()[cell] * dx + gy.ravel()[cell] * dy
            if F['how'] == 'mean':
                cnt = np.bincount(cell, minlength=n); tot = np.bincount(cell, zc, minlength=n)
                H = np.where(cnt > 0, tot / np.maximum(cnt, 1), np.nan)
            else:
                H = np.full(n, np.inf); np.minimum.at(H, cell, zc); H[np.isinf(H)] = np.nan
            H = H.reshape(cells.shape)
            S = inpaint(H)
    else:
        H = low.reshape(cells.shape)
    smooth = g(S, .7)
    gy, gx = gradient(smooth, cells.size); steep = length(gy, gx)
    m = np.isfinite(H).astype(float)
    r = np.where(m > 0, np.abs(S - g(S, 1.5)), 0)
    rough = g(r, F['rs']) / np.maximum(g(m, F['rs']), 1e-6)
    up = F['up'] + np.minimum(F['k'] * rough + F['c'] * steep, F['cap'])
    down = F['down'] + F['kd'] * rough + F['cd'] * steep
    return np.stack((S - down, S + up), axis=-1)
