"""Coverage of the 95 per cent intervals of crates/signal/src/extremes.rs by simulation, with numpy and scipy (1.17).

Prints: ln of the Weibull mode, deviation 0.0597 simulated and 0.0595 by the formula, coverage 0.943 (300 maxima, 4000 trials);
Gumbel mode six blocks on, 0.361 and 0.364, coverage 0.934 (30 blocks, 800 trials).
"""
import numpy as np
rng=np.random.default_rng(3)
n,N,b,a=300,1000.0,1.5,2.0
L=np.log(N); R=4000
x=a*rng.weibull(b,(R,n))
lx=np.log(x); mean=lx.mean(1)
beta=np.full(R,1.5)
for _ in range(50):
    p=x**beta[:,None]; s=p.sum(1); sl=(p*lx).sum(1); sll=(p*lx*lx).sum(1)
    f=sl/s-1/beta-mean; d=sll/s-(sl/s)**2+1/beta**2
    beta-=f/d
al=(x**beta[:,None]).mean(1)**(1/beta)
mpm=al*L**(1/beta)
E=0.5772156649; six=6/np.pi**2; slope=-np.log(L)/b**2
var=(1+six*(1-E)**2)/(n*b*b)+2*slope*six*(1-E)/n+slope**2*six*b*b/n
print('ln mpm std MC',np.log(mpm).std(),'formula',var**.5)
true=a*L**(1/b)
sl=-np.log(L)/beta**2
v=(1+six*(1-E)**2)/(n*beta**2)+2*sl*six*(1-E)/n+sl**2*six*beta**2/n
fac=np.exp(1.96*v**.5); print('coverage',np.mean((mpm/fac<true)&(true<mpm*fac)))
# Gumbel
n=30; R=4000; y=rng.gumbel(0,1,(R,n)); from scipy import stats
g=[stats.gumbel_r.fit(r) for r in y[:800]]; g=np.array(g); gr=np.log(6.0)
m=g[:,0]+g[:,1]*gr; v=g[:,1]*np.sqrt((1+six*(1-E+gr)**2)/n)
print('gumbel std MC',m.std(),'formula',np.sqrt((1+six*(1-E+gr)**2)/n),'coverage',np.mean(abs(m-gr)<1.96*v))
