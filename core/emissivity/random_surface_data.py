# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Table of `core.emissivity.random_surface`, by tools/tables/make_emission_table.py."""

SIGMA = (0, 2.5, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65)
POLAR = (0, 10, 20, 30, 40, 50, 60, 68, 75, 80, 84, 87, 89)
STEP = 0.0001
PACKED = (
    "c-muTMgqKWz{ksL0td!Mx`i;1pPibp4-EG1*|~Yuf~jI4AS%Mo_WS+)^W{KLR$7oA<z=DB^9TqY-nn#S!<?3Mub`lyKwlS"
    "QIhL2FSG65Idi3z_HB-vNOog8xb#!#J(G&lEbxm8G5!=3fdp6Cf4bl8{ep#`Li;KMu@3So}{tEB6H(b7aVr7HB*n_2omK^"
    "7~kpP!A63|!*1<RH#p4XoX1=*<)E=D<Ekewdorp5MXHVDj|)R<%=e0S+*Ao%$D#*WTF!NWDRwY4>6$+m3!OO^J<C@Lz-@x"
    "ELU^>do`4%5evAK%zsCAH3Um*aA+ix<ytua;XN-|{Q<gwCBimlwJoRjWUzJMEsSgv9^lO7*+`8P*>8qSMyuy`RT1x@FOA4"
    "*v=PB*5>41Z){$fa&j-yLMn;Yip%1^XI``Ft~kX@0?tt-`9ZP>ZPO0i;dn+u~Ji0Q&kfCv@4T)zVxzZ&z?QGu{npMle^}U"
    "(Wg(JUY~5{s5~Q^G<!#EY>eyw)-x;`-o@!H&dxS$ttYSC-*<5B%%&wvdZmJVgwD4{d;Gq#b!*AIGP#Lzz4|wz*e3S9o5tX"
    "gzU5otgOaa8NI=jF4!pfwm0&<wR^(R~6tq?)+skKwKzd4ylk~Gi$s2)S!<so&wjUQ-UCIQ4)G+NA9WrxSYPM|IvT1Rd+%k"
    "dcOFW_3+1ZKa554A||08drwsq^~sn(13oY=d0eL?(=9qUu~oSl)$ezDr<!GsC<=Z+LS@!jR|C6QtAA_v}@&0DVBkgZy7kd"
    "_desC_L${^6@9;_<>rK+qcrxT?Z{nu6G$iC{2cLQg}ci)t|#6r}sAeOR4y1PBiATi@fyxWVIoD-bjmx-u;^-Yn5~=gys5r"
    "{=nxGMxQhJ$Lcq#WQn7YtH^wa}9T6Vq$pM`tl#!_m_|6bt)=~pO)ADusc{{Po9{9!oLXjH{m<vmU?gU&dz2zt{vu+969Zc"
    ";H>VJl2n;(8V{#UZdm!Afl>fZNGKc(zyt#*91s^$5J0)GaskX?0Rb47g$0RAs@u>kWnx4sg5X9&jAw%aR#sLP77h?#XJ-f"
    "VIUxWfz{UnG3An&qZ~?}{1K|R58b3cDn9IotO2L8xP%beJ1#+;24%DTraKHj}8_01$*RXOy0nm9+=Kvi9bRQ>&AP|6@1at"
    "y7mnaa32n#`6Bnbo(;$k2^KcAeOoUDwrq=c9#kgKAitfVL}3*izMyvVLb4pC-Ah=PL@9*Ce&<beQ?J2^QZg%mWXL_h$|p`"
    "s!{KA*h2JkX_5l3<5}N+e~FOQnD=)z{b4(Nb4cR*(aFgnF)KL%5m~hpR!Zga$9j)k0ubOG!ydf&x%P80ZTH1)#HG;j6B$u"
    "BxI0bf%PqxTt}FzOJ^08rT<-0FqFvdH"
)
