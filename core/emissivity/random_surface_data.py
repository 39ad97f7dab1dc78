# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Table of `core.emissivity.random_surface`, by tools/tables/make_emission_table.py."""

SIGMA = (0, 2.5, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65)
POLAR = (0, 10, 20, 30, 40, 50, 60, 68, 75, 80, 84, 87, 89)
STEP = 0.0001
PACKED = (
    "c-muTMgn|DfY$^Lj16^)pr9~6J2ieU1nk+dY1RD6VqhS`&;Ix0gEJLCP+nG;5$$cM$oUWm?%%$6X#K3FRHuM|0Do_1BUz^"
    "BCzdrHJ$m%;?$wjaLX7#J9&mJYu+|m-er0uQj1k*`1N%15tqaxqb8%Uzvx|$p4)3$AZ2`(3cXeI9bbMt)fW)JfCAMsrxsd"
    ">uHWJWS1_z60_vArAPHMQbVGa;vXJ@5Fx@a)podW{1CO4-!N!*|F4G6xzyS=+BMC4!z$Onb-mP~sJ<+nRZOG}BfKVBUAX@"
    "bHk)klvWUEfwAzD940@dD{{=gw@Yl$|fr_$~2-&clZ{mU*63Z@ywW?SYPn$e*Q(^}CtP+s^z8X>Rh|&*z#nVbco<k3K;pA"
    "m9W8&dyG@Oi;kg^!MWpdnm9rko<M`4jA0Lw0mZj-j^F7aOK46O53k9v~_?$Q|8D1Z2rZPv+mx#d*{NMROWWJ$}^nLo;|z2"
    "xBOq>LE)gbxlvJ(PQM$DGsrl`#1vUuoBXRkdg;cl-K*!eu3I-<IVxD}Mt{2N_r0rEXU{5@ovb#?`DKo0XWNU(jDDqOB>EU"
    "@ZH1A5kT()=Re=FzS%ELzP|#kLXd{yj0%^%n_7acg#%uwC&FdG`IsaW{f3Oe;a$^nOb;~be%3rl=)ry(9Vhef8FR-b`#l?"
    "nbUb35d_%ojj=Y|dI`%PzTIkaxYlw{vks}_ZCIx;1m;Y5wa)7i7DZk(%r6@5JXQ|z;8Q%yK4x9)uS%4YJ;!ib=tXsz4nHr"
    ")KYW*1Og?SlZ`Zfa1VuBIUTZ4wmpHl#Z#LXvoXnz!<sWhuvj;Mk!}6GC`*`kw9W?d|EP^kH9OzFn;8(xpom4otQ_sz2?Wq"
    "TSS~Q@i8Y3yyw}HF41R`}g<ly8GW4Ufer2v0O-qbFYZv>y6(0dyA#DwK<alzsDZe+3LC0C@${D5sk>e{M>D<$~SAuGUB9n"
    "ng2hqeZ}b{21)@V44`l@04%*Rp>RN4NI?Kgj?74077&1OSy+&`q`D2wQYJ>EA_#6Y#CSF+U}a@xVc`G)c6N3!pA!N=0&Hy"
    "1l7I`$<plvA9tc-JfS;eA56I`{;^Y((5(4HtAQvP{j6;DOETIE+DJvYXK-~s%9MCnaTu=aX9@IG?8-Xt10B3yxkc)sW5ET"
    "^_5fK)GxJVKRB*eu)e11MTIXPJwX-Nq&Q6LwXzmyc^Wu>Jg#6?Aj3tnVbBZnw6B1FMK3J*k3DDpr6$eo<Pa1(&K6X;M85I"
    "}RNs0fhHCoeA#bg7gi$l-#(Or@#}ajBT7zP_H0mO6wlNj+DyAzaOg!_@-N_=dV#2<&PpDJe-%cmka%z^|a7ATI|CUv+ggR"
    "TU)#Igl?z4Gi>kwKdcrz5oC{45&H"
)
