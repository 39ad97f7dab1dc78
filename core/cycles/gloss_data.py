# SPDX-FileCopyrightText: 2011-2022 Blender Foundation
# SPDX-License-Identifier: Apache-2.0
"""Tables of Cycles for `core.cycles.gloss_facets`, by tools/tables/make_gloss_table.py.

Of what a GGX lobe of facets that absorb nothing returns: "kept", over the cosine of the view and
the roughness; "mean kept", its mean over the hemisphere. "share" is where the lobe's reflection
lies between that at the normal and the whole, over the index of refraction, the cosine of the view
and the roughness. Roughness runs fastest, and all axes from 0 to 1.
"""

STEP = 1 / 32767
TABLES = {
    "kept": (
        32,
        "c-n=~c|6p47zc1!(ROO}>a^?F61lHrFh=fUTxmwGhL{=GjJXf=TROJ#5(?Q;?AE>_Y*che+8jBy8<hzaA;&mo9Jzk`"
        "{mtkV_K$u3{JnqQ=lMJj9Pd}!+%+&P8XK3?m{>GAGCU+4=>Oc?-PQR49=vD#yLv=R^s}DZ&Uu3Vwo;BpmDfv$Vnt%<"
        "ESg^oPv0cy3)4goy|k8<qLK=8qm<6e`6S<{uDzQZ=f3GJJlpPi>zS>-sfQ-<v05N?|C$RjHiTfujn7!C(-n^l!gGV!"
        "rLBtnJ2bzLj5Sr|YJwWq?A+RS!JuG$XkPpGI`Ew6Z@rNY4ZHG2ZtjLcr&s92i>Gm4c&#c}Vl)|#hT(}OYN}k_Pn31q"
        "mBj+pu*_>&fzz}qv4U*RJqRU);V&JTBh}(;8HRyJ{fQVN-bi?C%sP~W-TZ{6kiHd$r+WS}uxqUGYw%GqJF8MdU2|p<"
        "h4;|tIIIBmVGCh+dZ5z(61k8s%U68&aSQc@er(Z$BHs2J8poTr;L~7uW~h<Z{w|2LA$4VLup5qkI_Co4{LO)i6`1go"
        "mn(pezDikZ(x)YpBEy)=qu8rYl#|BE6_eX^jr6s4!0@cNHP?va`?!JC=Uk*-VEZ9f0cuxw3-oi;lK=P!_*h4gdttE)"
        "8&jnmR=oUBtw!vF0a=;e$`elVwaLK8J8y@!Oq8w=Cv~g1FfKKWDyk@d*PLPBpQQaF0r*6BC416v?a?&MpRfCeg}s96"
        "oCx)LLO(@FpUZ;bxyjzzqe_GW!fjo?r&2f`TLouOO@VJ53RXwAxI6>?rLQq{*NH6Wbk3})(em=35%wUiM8^JDmAp^M"
        "&xj8^KW~-)<lO9ZddrIp!|R)=Wkbqne^%P<K0|PyxhY}OAK02Hfgeqk8o8rz6_%TpeLn3Nj}@0$w+Zo~*ZKZ!Y8wj$"
        "IkPgQyQrtr;{9|c9;HR@$1!doKHPepIBM%GHdjhawkde~wv4Csl%jZ#j?pv<20lIV?pBN(fn|~sKewSl$4RF<LE)D%"
        "is+QZs%2`3kG9|CDe*5x3EE@Mx)<C%rkXK=NfKBT+s(comH7LL1hv%49M#=|RZq0EyMk}_uGYn+ehQd<`Vw)`hljuF"
        "UTOa)=(ts!<CRPH`K`U5+S*1n5?0nfL|oiim26fvCC+@F)pK8Yeg60gQQf&10;6R6^K#%b;;!1WHZ?zNu2ULt(N0ZV"
        "=V&E=D`4&0hC!#!M~IJosypZWO4EGY3w1SJW|W=HRlTNN7NBd)UDhP=?#67d_m()-lZo(TG@(s&$0kpf^!c|VC0ZjA"
        "?|G7g@5j;{?pJ%_n;UJhGvuO=YS0>i$RD}y%y{q9%Rys7C&LG1FP4~_<X^STxKrQxW0Dm*!x4&y{-+M}nRGgX#pZB%"
        "^Tp+IIBYhH$zafF$Pck>28~8%Fqte#F`3|d43!cc6&XQBI>hriOgaq|9VwdBBEreUutUL;32}TjlO7`}DwXmL4+aHD"
        "BE-k?zzC@!UBgMlP@sYS2k_E}@q8|eL8H#A<Siix=zi~ckL7^~F_cA*eQ`cs9`ifKNgGHfOW4mBx6jkv6<XK;aWW}v"
        "{x!l*UtQ85h60=z8iLFQ%>mngJz^YKfk~4%cpl(~_wn{{b9S(WmJEm>gZ9YteV$ksM_UZEctCU{Z~_RoU(($M{mo;!"
        ";6@bSA;9tAIp}U}`PHQZq<%2q0M6UP)ydAr3I%-&z~`{&)TnSGaHKt$Zf&^-S{eXxe_tOjth4=IG|Fs|vw=qt4;}Q!"
        "`*^xJ*<mcrO&7Q{Km-Z#eIBl$y@i<xv^XH05-D|e7YEROx6wie0q9hzd%L^X+gO>K8bV6~QlrSBh-00>_&p{D(9(dw"
        "3H~^5tdpI!#cm@#Xi-2m6D&CIwrG^8p)Ry^f#~os;9hQyd(q~m20GAx7Yri=NZe|ViM}?pXaR6xN(3=D01w>8(#%+I"
        "7xbS6=iLFgk)GB<kCPr?-Z2)t4Rtk_IGX_u6aw58IEc5zdB_1sA%Vc{F(^|5?VbMubusyv",
    ),
    "mean kept": (
        32,
        "c-s5_|Idf3ivw@y`RbmM*LV_A5%SKfxWJqLShX4B)8~9~^$<{3S6fq6Szc0<pOcZA7#kTH;N#(9Z*5@$05U!uP5",
    ),
    "share": (
        16,
        "c-rk*cU05apG`<Y3h6y0ApsH~p#>xmigcudAP9(sj$onMkfI=9L#!0Rf&zjlI4Glnqk=eq4aBtrDky?&aB!T#8Fjzk"
        "Bw*Ryb9U#<ue$di_&^Tl-TUt6z0bQqAm291f2wvLi2a?7iG{WA&WN9z>XWKHFv|Ei`{m(`1s>Ltii1^=ZRiBZi8b?Q"
        "NJV_s`;Q3pZ@pFNbDgK@YB0$7;NZ{&VIf|&5+RpP!l|JI0->%*PsmrNk#HE4DuPHPk|-1kiGT$wI1B{<jlrN%NU(yb"
        "zyTmYz`;rdssaKA0{9A@!c+k)8TuJM5&8W4{{yZ@xHsw)|Jq}i7FxzUljgZkuWiZAtTbb6WfN(iH~C4|dAqdisP5s-"
        "<!>^@FV2>Gc)Gwm%xUbP_7F^WWlp@z%HDy0ZQj!?{gI}^q)_+VyiGfHX3x?2`9j(12p>Ds*4FmR*RNmvt~fJxmXo=G"
        "c4TC9TtaeE+<ZT0nURhL%gjt_VQpt`XJuxn1B%9GbGSS$flynM%c7A9SUet2Ad;yx8kIuAV=-tX02Epc3qTD6hzKeL"
        "2&fAFTosU1sTK?_2MngvMxiT!&-9X`pL#t9f5yF_4sP-S5jL{*O_c7$gw~T=b0_>ofz7UCLH05n`hxr2z&vZOy&6BH"
        "9I0J?aCp5Yexa@`7gFv^y>z)_4?_gGcLy0Uv{w52)iXa_Xg?Hm%dSqZC6YVbQc_a7x2CRSp=M9cbd}!28<P?eQ#0~6"
        "q|Z0UJZvt_h?#Zy^0k`-!%zFKoG4$nG}O~JAt7m5`nnApa#qIA^>MT?w6?afbN2A{_xEwNvoO}x<Z?Cm+PVf36B8q`"
        "jwXkR!{P8m3PYX4<+53H3JJ6l5{1DLh$Iq`fWyk=02Bg51AszJk_Qz6Kl|8#B57}SE9i=Yx}kZ=uhX6^KX;==JiOTU"
        "_YjfWUT(n>GVUD4Y!@rP%4zzlp@gy>)B3DhZS)&E1FU1(U5B;!n2HL7x@?D)XjZ*p=c<W!?;dX(e*NI~PsZD6jgf*`"
        "0U`5!D2EuUpGN&s>Pvnk6zZGXPQ!Mlu-aEzKzfhfymjx%&+o?XHl(}JM_c!=!(s^xfr*8wCUUf^ZtJS39XocFRejfT"
        "uI0Om!u0q#o}QlGe!=03l9#0{jtus4lxb;c>xfM(?OkTLIM_&y^*}vHbT(h8Cl=`n_#C-CkQh9PN@p+_G>VcvTor{;"
        "!{V^mkq;BL{5yjMQor=L!E?h7zl6Uvg#;lXw`n24ednIqFLiHowQu~RV6NF+W=AJ1uH~3<n#K5@ONXU?589vEw_NY8"
        "MwBh?pDUg-+%}-U$I#SN^lMxcWF_p(;mgboj20hXKTqBXxbF1ueeaTCHS@*#5=#rl)zBL=+Pp`1`cQRs4J~K5nL<xT"
        "6VI=-g5Mb!7<%;)M^qVX%J$)ob=43EWRBR{&CAJ{GJd0}bZuebwvx)@tyj9cemGK^n-cEi<l^o(FK$^zR{F9<VF7L|"
        "mO58UG|k4v!^_jv(b^1b4Gf;DuBjt7Fc9ks<os0-C^Z6w&R{Yb&rt3Qid^XlXV=HE7LXZ1r}er;6YM1uQI66v+c&?N"
        "rFtKS?%TI0<F-fHF6@K1cE_tpf~>PcTi*+RvKk$tr)p`8XvE*>>2qR*P7JCBUpZV`>a*1$_rPtZvHO3xopKs`J=RzB"
        "fim84^!vx=)h4}U3WJTi8GDHmQb*pR(Y9>ms;rGWH%F^CIbI8g9*q{A`Jt`*(W~dzE5evPn|)Z%N=o<Cv~>6NU#-sz"
        "(TChS+28+YbOOgSFcOd_`dh0D;^P;mWNz7itoh8zBYO%~$Lop2Mp6ggd2xv;NsA&vd;rs{5$Qb9G;0TECkGn~Iej=1"
        "OJ;JlggQEc=PUgCXEE>7>>lkk2z)(Ao^v@5@e9+p;aN%8TS05X-DejBQKJ{;%R-8qHxKSEyB-tV^8N73Ui-v|_x$>T"
        "+Bc0y6StjsTA94ZZr0_U`|eMFGITAan4?c5c=eQ&b?aBPwVkb)QJ5~dQ?z<x8@EU|ZFOdP1hcUB9Y3%Fnae!8c5U9)"
        "T{&K_l7{ErUkGoAO-)V9FR3U=kv`sRHdqqGBM@ntQjgiQY^aZFlcwW_1Oh!%=g`EAjKm-d>g(?B3JbTF*0l5ty?XuZ"
        "erIEOzD#Cm>lU;yZT<FL+c#z<M`N)#B27bN?&K2~5*+C3rr3TAk;&IHGMzTf<aq$^w6_U1XoK<d6?>#wK5t?rJ)@?%"
        "Z)GF(_VLi?r0!aBG-Be=riSO}o5I_@@R~9RMCNK*ajn^V;ZGd{+U6$XB-1d)0Hov~`Nl1^g?YJ43F7LSwW(DaeYar2"
        "S7Tzr?E2K-?YDYy@zR9%IZpzCgndy0x0;<$+GlmlcHs9vpeXd~M)x+uQeu&Q&$`~;JCDaFo}F8z*&2aqPL=ul2Su&e"
        "v};Ss4E*(-b98?5@trj<F~7X#Q1R+u6U>tf)rV>uTW`IDU~z~y4?60L9UYzB1EN-LDyyogEGt}-L?93;ENzLMcSv}2"
        "bod;9kUvZnOW_EOq*m6}veDd?N2E>*Ue1-WJ5eW&jYw-(OS746xwyBZdk44VH@ENSR+m11Ygnun;CLiCqlJadJfObv"
        "#G+f{^&@#nMNd6l2@d(s`tKW$ajMb^x-Cp3?2B&-nwqX~8nO#IbSv}ovm;RfZmOr(EXh90DHiADt<Q;~Zn*kZV|Jz5"
        "M&8Av^^K=a?u+=CH6A;hj6aoFd$|7ekC&RadQa?i9;=KH+1We$h9{>b2N}F=S?kGq>E`A&J2t(rv?y<pyWnGAOI20P"
        "v9rBTCt&bDUfe!kvrW!Fa{2n=ii7)$H)SkU@He*g3J!~mTo63-bN-grR<b889ng?E$2ndl1NTBKLXV60rUn1XPJ94~"
        "zj!UsJml!@lc8RN<7aE@D`%HD+oj%k^KALk$1m?njoTl_xkNPZLxYVA4KVq*`|#X=hy&;?i3t&c+$Fz+_O9>`EB}y5"
        "@9OF}p8TA{XKA@@8BazZFD}_#vd(kRuTCZUUc~#F@c9cO7RHAdKFXq0JB*YDY4lwGkN%Mtk6O3*AY0eWAP={+oa?wb"
        "I6BmQbX|}ba`)8x4-gbhXl7$&$oepN@$j}aYjZa2Jb3(kXII<z)jP8jfqBBx(K|G5S$gK`)J0)|fd2_pwoqd2?BVU@"
        "?rf{@Kbk=23Pc7*hWdS$hjpzqD$gD`f6~!xY2VVlG>Y%Rz7^W@8m}ZIG-{n7{5rHd;>JgbpJ`=g<;S(W%RgqVirIh3"
        "*Ry&3zE?5t563MGM%n$gWVkSO`@_JI9lk}yMLE-tJ%x)F{^)Q!+ZOr#$>x^YWJ(cn8^1M4@~->m@we|ky!tWUa&%7!"
        "@72YFw{G8iI5OIIzBopT>_5GGji#oy$V6r-;ix>mShHnCR9)TC#?x(`oo!8(+cFo=^$rUQkBU!D%gkDx5;xCphP6au"
        "GEHXd;^{ln+Z{OW4Ji~Vjmg#4GnAM}zzG4k<-rSpOa~_fjyh9u{=-yJYB&N37!kTq*P4h&A`V0#3=X)WAGDgBbh_td"
        "-!$fAQzRa2*pwtQKEcR&hdc9d=2$~cq?h%hVM_2kT=}$z2bKrfO9X5P6l*+h#qwxBTO%zN1&;y#Ivhiy(I^BgS{3nW"
        "{(}C=`Sfp%?eQ<|pVU7l9a`!wGtlO;AU;iZEl(|W6tT%zlqwwd@BaQtF;EXpG-lvX2>J5^`pv!nFi^<<<J(16h$$P7"
        "g2N`QPbL$wNH}b&5fm@+zu=+$&&og6)kuRPKkDQWgOQPlPbXlI2t^42?g;QCmkR_Em%p<SQzZm8DG>CFXZ62~Mp;Yz"
        "tVA3t9s?)<N?>Pa1zcn#@bZ!?!sqii3=$5FRFqI65qMRrO_fkE&p{zo!SF`TdNOyIlw>k@nAGIIi*Ej*{1by6CEDr~"
        "JirO0?BVV#)8{iuIE*5o($^R3@PLb54W$r-#bPmNq^S~0AQ134Wwr&fRO*44lmIaqZYd>z!9EYS{%e@^_tqyXDb&?m"
        "4@~mp0w8A2^sqD4;nIon^bQUOo=Ao|@?WEnAPqjBufe9vKP~4-1wba^CQB6@4yQ<_lnN;HP_zul8S#182LSe!AYY_?"
        "Uxs~u8~!QtJuD5h)Ttl`VB-P;e4M0WJ`<eZ009s(nYpQ0i%kRd00j^Vh1xtY+*InpVlkO?ic$c8BN1#6Ja$R|3<xxO"
        "$`MFqP&a81IQ&z`sC<^weWAzK68wdFWTh<dv^LV_&`I(|BWDNBbg@wAfdN--Wo2n*AmC2=1Fom1E7asLl=8q~Y&Kh+"
        "2?mvl7J!ifkcjxnQU$9>DyIZMO*V*90L15pQ2FGCNke=o$5(p%W&8ykz|vSSl@1J?=?wCx$^D?J3i3CU^H=ymPft%r"
        "iwoLA(H|TR8_XREN_)U40LVn80RTVX<PCvAE9Fp8q>!IZ2n0eEbi-6fz`hdTf8_^-BmNx!<azF(|G_g2%#&yNdpiRD"
        "XHh|dz$z^)%uN9Q1NKntzmASjo3A_oKo08a>MRD8gjd=DCf|O7T)V&P{{LAsWF>~UnCU9cKX6&zUamIALXP~u7vP#D"
        "5@Y?(><{DdcwBWl;CCe>nlhQ6<ckM@!z%fzDE1qz+;5PCsvMtggsJw2ea-iO+V8*iJj`0+Z==tn6DRpNIM|p7*;Im>"
        "l8-=Ji>FQn=_&{S$32CF|1<!|w--Hi{VC5k#AFGDe>D)Od^HgK!|%TsXMHviGd17=*FA><PQc2U7wBF!6audDX}(h|"
        "{@-T)4HS`)urKHPZ|OytsjK=;KY;DO@%Qh40-@E(%>",
    ),
}
