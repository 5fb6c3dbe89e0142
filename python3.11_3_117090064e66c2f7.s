	.att_syntax
	.file	"3"
	.section	.rodata,"a",@progbits
	.p2align	6, 0x0
.LCPI0_0:
	.long	0
	.long	2
	.long	4
	.long	6
	.long	8
	.long	10
	.long	12
	.long	14
	.long	16
	.long	18
	.long	20
	.long	22
	.long	24
	.long	26
	.long	28
	.long	30
.LCPI0_37:
	.long	8
	.long	24
	.long	9
	.long	25
	.long	10
	.long	26
	.long	11
	.long	27
	.long	12
	.long	28
	.long	13
	.long	29
	.long	14
	.long	30
	.long	15
	.long	31
.LCPI0_38:
	.long	0
	.long	16
	.long	1
	.long	17
	.long	2
	.long	18
	.long	3
	.long	19
	.long	4
	.long	20
	.long	5
	.long	21
	.long	6
	.long	22
	.long	7
	.long	23
.LCPI0_39:
	.long	0
	.long	16
	.long	2
	.long	18
	.long	4
	.long	20
	.long	6
	.long	22
	.long	8
	.long	24
	.long	10
	.long	26
	.long	12
	.long	28
	.long	14
	.long	30
.LCPI0_40:
	.long	1
	.long	3
	.long	5
	.long	7
	.long	9
	.long	11
	.long	13
	.long	15
	.long	17
	.long	19
	.long	21
	.long	23
	.long	25
	.long	27
	.long	29
	.long	31
	.section	.lrodata.cst4,"aMl",@progbits,4
	.p2align	2, 0x0
.LCPI0_1:
	.long	1
.LCPI0_2:
	.long	0x3f800000
.LCPI0_3:
	.long	0x45800800
.LCPI0_4:
	.long	0x80000000
.LCPI0_5:
	.long	0x40800008
.LCPI0_6:
	.long	0x3f800002
.LCPI0_7:
	.long	0x7f800000
.LCPI0_8:
	.long	0x3f000000
.LCPI0_9:
	.long	0x40278dde
.LCPI0_10:
	.long	0x40800000
.LCPI0_11:
	.long	0xbf800000
.LCPI0_12:
	.long	0x40878dde
.LCPI0_13:
	.long	0x3f5db3d7
.LCPI0_14:
	.long	0xbf000000
.LCPI0_15:
	.long	0xbf5db3d7
.LCPI0_16:
	.long	0x402aaaa9
.LCPI0_17:
	.long	0x402ab000
.LCPI0_18:
	.long	0x39aae000
.LCPI0_19:
	.long	0xb9aae000
.LCPI0_20:
	.long	0x33eca30a
.LCPI0_21:
	.long	0xc0aaaaaa
.LCPI0_22:
	.long	0x40aab000
.LCPI0_23:
	.long	0x3a2ac000
.LCPI0_24:
	.long	0xb46e8cf6
.LCPI0_25:
	.long	0x40aaaaab
.LCPI0_26:
	.long	0x3a2aa000
.LCPI0_27:
	.long	0xba2aa000
.LCPI0_28:
	.long	0x3409ae7e
.LCPI0_29:
	.long	0xc0aaaaab
.LCPI0_30:
	.long	0xb30b986d
.LCPI0_31:
	.long	0x40c00000
.LCPI0_35:
	.long	0x3eaaaaab
.LCPI0_36:
	.long	0x3a800000
.LCPI0_41:
	.long	0x7fffffff
.LCPI0_42:
	.long	7
.LCPI0_43:
	.long	8
.LCPI0_44:
	.long	0x36800000
.LCPI0_45:
	.long	0xc0878dde
.LCPI0_75:
	.long	0xc02ab000
.LCPI0_76:
	.long	0xba2ac000
	.section	.lrodata.cst8,"aMl",@progbits,8
	.p2align	3, 0x0
.LCPI0_32:
	.quad	2
.LCPI0_33:
	.quad	3
.LCPI0_34:
	.quad	4
	.section	.lrodata.cst16,"aMl",@progbits,16
	.p2align	4, 0x0
.LCPI0_46:
	.long	0x00000000
	.long	0x3efffffe
	.long	0xc02aaaa9
	.zero	4
.LCPI0_47:
	.long	0x00000000
	.long	0x3f000000
	.long	0xc02ab000
	.zero	4
.LCPI0_48:
	.long	0x00000000
	.long	0xb3800000
	.long	0x39aae000
	.zero	4
.LCPI0_49:
	.long	0x00000000
	.long	0xb2516497
	.long	0xb324ecee
	.zero	4
.LCPI0_50:
	.long	0x00000000
	.long	0xbfaaaaaa
	.long	0x40d55555
	.zero	4
.LCPI0_51:
	.long	0x00000000
	.long	0xbfaab000
	.long	0x40d55000
	.zero	4
.LCPI0_52:
	.long	0x00000000
	.long	0x392ac000
	.long	0x3a2aa000
	.zero	4
.LCPI0_53:
	.long	0x00000000
	.long	0xb36e8cf6
	.long	0x3328c0cc
	.zero	4
.LCPI0_54:
	.long	0x00000000
	.long	0x40800000
	.long	0xc1155556
	.zero	4
.LCPI0_55:
	.long	0x00000000
	.long	0x40800000
	.long	0xc1155000
	.zero	4
.LCPI0_56:
	.long	0x00000000
	.long	0x00000000
	.long	0xbaaac000
	.zero	4
.LCPI0_57:
	.long	0x00000000
	.long	0x339a2c95
	.long	0x34949d9c
	.zero	4
.LCPI0_58:
	.long	0x3f800000
	.long	0xc0caaaab
	.long	0x412aaaab
	.zero	4
.LCPI0_59:
	.long	0x3f800000
	.long	0xc0cab000
	.long	0x412ab000
	.zero	4
.LCPI0_60:
	.long	0x00000000
	.long	0x3a2aa000
	.long	0xbaaaa000
	.zero	4
.LCPI0_61:
	.long	0x00000000
	.long	0x33ee8cf2
	.long	0xb3a8c0bc
	.zero	4
.LCPI0_62:
	.long	0x3efffffe
	.long	0xc02aaaa9
	.long	0x402aaaa9
	.zero	4
.LCPI0_63:
	.long	0x3f000000
	.long	0xc02ab000
	.long	0x402ab000
	.zero	4
.LCPI0_64:
	.long	0xb3800000
	.long	0x39aae000
	.long	0xb9aae000
	.zero	4
.LCPI0_65:
	.long	0xb2516497
	.long	0xb324ecee
	.long	0x33eca30a
	.zero	4
.LCPI0_66:
	.long	0xbf93cd3a
	.long	0x40b8c088
	.long	0xc093cd3a
	.zero	4
.LCPI0_67:
	.long	0xbf93d000
	.long	0x40b8c000
	.long	0xc093d000
	.zero	4
.LCPI0_68:
	.long	0x38b18000
	.long	0x38880000
	.long	0x39b18000
	.zero	4
.LCPI0_69:
	.long	0x32b2065e
	.long	0x3410bc05
	.long	0x33b2065e
	.zero	4
.LCPI0_70:
	.long	0x40000000
	.long	0xc0955556
	.long	0x402aaaab
	.zero	4
.LCPI0_71:
	.long	0x40000000
	.long	0xc0955000
	.long	0x402ab000
	.zero	4
.LCPI0_72:
	.long	0x00000000
	.long	0xba2ac000
	.long	0xb9aaa000
	.zero	4
.LCPI0_73:
	.long	0x331a2c95
	.long	0x34149d9c
	.long	0x3389ae7e
	.zero	4
	.section	.lrodata.cst32,"aMl",@progbits,32
	.p2align	5, 0x0
.LCPI0_74:
	.long	0
	.long	8
	.long	1
	.long	9
	.long	2
	.long	10
	.zero	4
	.zero	4
	.section	.ltext,"axl",@progbits
	.globl	camera
	.prefalign	4, .Lfunc_end0, nop
	.type	camera,@function
camera:
	endbr64
	pushq	%rbp
	movq	%rsp, %rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	andq	$-64, %rsp
	subq	$8064, %rsp
	movq	208(%rdi), %rax
	movq	8(%rsi), %rdx
	movq	200(%rdi), %r12
	movq	(%rsi), %r9
	movslq	28(%rdi), %r8
	movslq	24(%rdi), %rcx
	imulq	%rax, %rdx
	addq	48(%rdi), %rdx
	imulq	%r12, %r9
	addq	40(%rdi), %r9
	movq	%rcx, 24(%rsp)
	addq	%rdx, %rax
	movq	%r9, 32(%rsp)
	cmpq	%r8, %rax
	cmovgeq	%r8, %rax
	addq	%r9, %r12
	cmpq	%rcx, %r12
	movq	%rax, 40(%rsp)
	cmovgeq	%rcx, %r12
	movq	%r12, %rcx
	subq	%r9, %rcx
	testq	%rcx, %rcx
	jle	.LBB0_97
	movq	40(%rsp), %rax
	subq	%rdx, %rax
	testq	%rax, %rax
	jle	.LBB0_97
	movq	%rdx, 192(%rsp)
	movq	8(%rdi), %rdx
	movq	(%rdi), %rax
	movq	16(%rdi), %rsi
	movabsq	$.LCPI0_8, %r14
	movabsq	$FACTORS, %r13
	movabsq	$.LCPI0_35, %r11
	movq	%r8, 184(%rsp)
	movq	%rcx, 560(%rsp)
	movq	%rdx, 224(%rsp)
	movabsq	$9223372036854775792, %rdx
	movq	%rax, 232(%rsp)
	movabsq	$.LCPI0_41, %rax
	movq	%rsi, 216(%rsp)
	andq	%rcx, %rdx
	addq	32(%rsp), %rdx
	movq	%rdx, 200(%rsp)
	movabsq	$.LCPI0_36, %rdx
	cmpq	$16, %rcx
	jae	.LBB0_3
.LBB0_33:
	testb	$15, 560(%rsp)
	movq	192(%rsp), %rsi
	movq	184(%rsp), %rcx
	je	.LBB0_97
	movabsq	$.LCPI0_2, %rdi
	vcvtsi2ssl	24(%rsp), %xmm15, %xmm13
	movabsq	$.LCPI0_3, %r8
	vcvtsi2ss	%ecx, %xmm15, %xmm0
	vxorps	%xmm6, %xmm6, %xmm6
	vmovss	(%rdi), %xmm14
	movabsq	$.LCPI0_4, %rdi
	vmovss	(%r8), %xmm20
	movabsq	$.LCPI0_5, %r8
	vbroadcastss	(%rdi), %xmm18
	movabsq	$.LCPI0_7, %rdi
	vmovss	(%r8), %xmm19
	vmovss	(%rdi), %xmm21
	vmovss	%xmm0, 2560(%rsp)
	vmovss	%xmm14, 2752(%rsp)
	vmovss	%xmm20, 2688(%rsp)
	vmovss	%xmm13, 2816(%rsp)
	vmovups	%xmm18, 528(%rsp)
	vmovss	%xmm19, 48(%rsp)
	vmovss	%xmm21, 2624(%rsp)
	jmp	.LBB0_35
	.p2align	4
.LBB0_96:
	movq	%r13, %rsi
	incq	%rsi
	cmpq	40(%rsp), %rsi
	je	.LBB0_97
.LBB0_35:
	vmovss	2560(%rsp), %xmm1
	leal	1(%rsi,%rsi), %ecx
	movq	24(%rsp), %r10
	imull	%esi, %r10d
	movq	%rsi, %r13
	vcvtsi2ss	%ecx, %xmm30, %xmm0
	movq	200(%rsp), %rcx
	vsubss	%xmm0, %xmm1, %xmm0
	vdivss	%xmm1, %xmm0, %xmm12
	vmovss	%xmm12, 2880(%rsp)
	jmp	.LBB0_36
.LBB0_93:
	addl	%r9d, %esi
.LBB0_94:
	vmovss	2880(%rsp), %xmm12
	vmovss	2048(%rsp), %xmm15
	leal	(%rdi,%rsi,4), %esi
	vmovaps	%xmm8, %xmm1
.LBB0_95:
	movq	224(%rsp), %r8
	movq	216(%rsp), %r9
	vaddss	%xmm1, %xmm15, %xmm0
	leal	(%r10,%rcx), %edi
	incq	%rcx
	movslq	%edi, %rdi
	vmovss	%xmm0, (%r8,%rdi,4)
	movl	%esi, (%r9,%rdi,4)
	cmpq	%r12, %rcx
	je	.LBB0_96
.LBB0_36:
	leal	1(%rcx,%rcx), %esi
	movq	232(%rsp), %rdi
	vcvtsi2ss	%esi, %xmm30, %xmm0
	vsubss	%xmm13, %xmm0, %xmm0
	vmulss	36(%rdi), %xmm12, %xmm7
	vmovss	(%rdi), %xmm3
	vmovss	4(%rdi), %xmm2
	vmovss	8(%rdi), %xmm1
	vdivss	%xmm13, %xmm0, %xmm0
	vmulss	24(%rdi), %xmm0, %xmm4
	vmulss	28(%rdi), %xmm0, %xmm5
	vmulss	32(%rdi), %xmm0, %xmm0
	vaddss	12(%rdi), %xmm4, %xmm4
	vaddss	16(%rdi), %xmm5, %xmm5
	vaddss	20(%rdi), %xmm0, %xmm0
	vaddss	%xmm7, %xmm4, %xmm4
	vmulss	40(%rdi), %xmm12, %xmm7
	vaddss	%xmm7, %xmm5, %xmm5
	vmulss	44(%rdi), %xmm12, %xmm7
	vmulss	%xmm5, %xmm5, %xmm8
	vaddss	%xmm7, %xmm0, %xmm0
	vmulss	%xmm4, %xmm4, %xmm7
	vaddss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm0, %xmm8
	vaddss	%xmm7, %xmm8, %xmm7
	vsqrtss	%xmm7, %xmm7, %xmm7
	vdivss	%xmm7, %xmm14, %xmm7
	vmulss	%xmm7, %xmm4, %xmm24
	vmulss	%xmm7, %xmm0, %xmm26
	vxorps	%xmm0, %xmm0, %xmm0
	vmulss	%xmm7, %xmm5, %xmm25
	vsubss	%xmm3, %xmm0, %xmm4
	vsubss	%xmm2, %xmm0, %xmm5
	vsubss	%xmm1, %xmm0, %xmm7
	vmulss	%xmm24, %xmm4, %xmm4
	vmulss	%xmm25, %xmm5, %xmm5
	vmulss	%xmm20, %xmm24, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vmulss	%xmm26, %xmm7, %xmm5
	vsubss	%xmm24, %xmm8, %xmm9
	vaddss	%xmm4, %xmm5, %xmm15
	vsubss	%xmm9, %xmm8, %xmm8
	vmulss	%xmm20, %xmm15, %xmm5
	vmulss	%xmm15, %xmm24, %xmm4
	vsubss	%xmm8, %xmm24, %xmm9
	vsubss	%xmm15, %xmm5, %xmm7
	vsubss	%xmm7, %xmm5, %xmm5
	vmulss	%xmm5, %xmm8, %xmm10
	vsubss	%xmm5, %xmm15, %xmm7
	vmulss	%xmm5, %xmm9, %xmm11
	vsubss	%xmm10, %xmm4, %xmm10
	vmulss	%xmm7, %xmm8, %xmm8
	vmulss	%xmm7, %xmm9, %xmm9
	vsubss	%xmm11, %xmm10, %xmm10
	vsubss	%xmm8, %xmm10, %xmm8
	vsubss	%xmm8, %xmm9, %xmm8
	vaddss	%xmm4, %xmm3, %xmm9
	vsubss	%xmm3, %xmm9, %xmm10
	vsubss	%xmm10, %xmm9, %xmm11
	vsubss	%xmm10, %xmm4, %xmm4
	vsubss	%xmm11, %xmm3, %xmm3
	vaddss	%xmm3, %xmm4, %xmm3
	vmulss	%xmm20, %xmm25, %xmm4
	vaddss	%xmm3, %xmm8, %xmm3
	vsubss	%xmm25, %xmm4, %xmm8
	vsubss	%xmm8, %xmm4, %xmm4
	vaddss	%xmm3, %xmm9, %xmm29
	vmulss	%xmm15, %xmm25, %xmm3
	vmulss	%xmm5, %xmm4, %xmm9
	vsubss	%xmm4, %xmm25, %xmm8
	vmulss	%xmm7, %xmm4, %xmm4
	vmulss	%xmm5, %xmm8, %xmm10
	vsubss	%xmm9, %xmm3, %xmm9
	vmulss	%xmm7, %xmm8, %xmm8
	vsubss	%xmm10, %xmm9, %xmm9
	vsubss	%xmm4, %xmm9, %xmm4
	vsubss	%xmm4, %xmm8, %xmm4
	vaddss	%xmm3, %xmm2, %xmm8
	vsubss	%xmm2, %xmm8, %xmm9
	vsubss	%xmm9, %xmm8, %xmm10
	vsubss	%xmm9, %xmm3, %xmm3
	vsubss	%xmm10, %xmm2, %xmm2
	vaddss	%xmm2, %xmm3, %xmm2
	vmulss	%xmm20, %xmm26, %xmm3
	vaddss	%xmm4, %xmm2, %xmm2
	vsubss	%xmm26, %xmm3, %xmm4
	vsubss	%xmm4, %xmm3, %xmm3
	vaddss	%xmm2, %xmm8, %xmm28
	vmulss	%xmm15, %xmm26, %xmm2
	vsubss	%xmm3, %xmm26, %xmm4
	vmulss	%xmm5, %xmm3, %xmm8
	vmulss	%xmm7, %xmm3, %xmm3
	vmulss	%xmm5, %xmm4, %xmm5
	vmulss	%xmm7, %xmm4, %xmm4
	vsubss	%xmm8, %xmm2, %xmm7
	vsubss	%xmm5, %xmm7, %xmm5
	vsubss	%xmm3, %xmm5, %xmm3
	vsubss	%xmm3, %xmm4, %xmm3
	vaddss	%xmm2, %xmm1, %xmm4
	vsubss	%xmm1, %xmm4, %xmm5
	vsubss	%xmm5, %xmm4, %xmm7
	vsubss	%xmm5, %xmm2, %xmm2
	vsubss	%xmm7, %xmm1, %xmm1
	vaddss	%xmm1, %xmm2, %xmm1
	vmulss	%xmm25, %xmm25, %xmm2
	vaddss	%xmm3, %xmm1, %xmm1
	vmulss	%xmm28, %xmm25, %xmm3
	vaddss	%xmm1, %xmm4, %xmm7
	vmulss	%xmm24, %xmm24, %xmm1
	vaddss	%xmm2, %xmm1, %xmm1
	vmulss	%xmm26, %xmm26, %xmm2
	vmovss	%xmm7, 64(%rsp)
	vaddss	%xmm1, %xmm2, %xmm1
	vmulss	%xmm29, %xmm24, %xmm2
	vaddss	%xmm3, %xmm2, %xmm2
	vmulss	%xmm7, %xmm26, %xmm3
	vaddss	%xmm2, %xmm3, %xmm2
	vxorps	%xmm18, %xmm2, %xmm2
	vdivss	%xmm1, %xmm2, %xmm2
	vmulss	%xmm2, %xmm24, %xmm3
	vmulss	%xmm2, %xmm25, %xmm4
	vmulss	%xmm2, %xmm26, %xmm5
	vaddss	%xmm3, %xmm29, %xmm3
	vaddss	%xmm4, %xmm28, %xmm4
	vaddss	%xmm5, %xmm7, %xmm5
	vmulss	%xmm3, %xmm3, %xmm3
	vmulss	%xmm4, %xmm4, %xmm4
	vaddss	%xmm4, %xmm3, %xmm3
	vmulss	%xmm5, %xmm5, %xmm4
	vaddss	%xmm3, %xmm4, %xmm3
	vsubss	%xmm3, %xmm19, %xmm4
	vmovaps	%xmm14, %xmm3
	vucomiss	%xmm4, %xmm0
	ja	.LBB0_38
	vdivss	%xmm1, %xmm4, %xmm0
	movabsq	$.LCPI0_6, %rsi
	vsqrtss	%xmm0, %xmm0, %xmm0
	vmulss	(%rsi), %xmm0, %xmm0
	vsubss	%xmm0, %xmm2, %xmm3
	vaddss	%xmm0, %xmm2, %xmm0
.LBB0_38:
	vsubss	%xmm15, %xmm6, %xmm1
	vsubss	%xmm15, %xmm21, %xmm2
	xorl	%esi, %esi
	vmaxss	%xmm1, %xmm3, %xmm1
	vminss	%xmm2, %xmm0, %xmm2
	vucomiss	%xmm1, %xmm2
	jb	.LBB0_95
	vmovss	(%r14), %xmm3
	movabsq	$.LCPI0_13, %rsi
	vsubss	%xmm1, %xmm2, %xmm0
	vaddss	%xmm2, %xmm1, %xmm1
	vmovss	64(%rsp), %xmm12
	vmovss	%xmm2, 1344(%rsp)
	vmovss	%xmm15, 2048(%rsp)
	vmovss	%xmm24, 1408(%rsp)
	vmovss	%xmm25, 896(%rsp)
	vmovss	%xmm26, 832(%rsp)
	vmovss	%xmm29, 704(%rsp)
	movabsq	$.LCPI0_47, %rbx
	vmovss	(%rsi), %xmm5
	movabsq	$.LCPI0_9, %rsi
	vmovss	(%rsi), %xmm13
	movabsq	$.LCPI0_11, %rsi
	vmulss	%xmm3, %xmm0, %xmm4
	vmulss	%xmm3, %xmm1, %xmm10
	vmovups	%xmm5, 1920(%rsp)
	vmovss	%xmm13, 576(%rsp)
	vsubss	%xmm4, %xmm10, %xmm1
	vmulss	%xmm5, %xmm4, %xmm0
	vmulss	%xmm3, %xmm4, %xmm2
	vmulss	%xmm6, %xmm4, %xmm3
	vmovss	%xmm4, 256(%rsp)
	vaddss	%xmm4, %xmm10, %xmm4
	vmovss	%xmm10, 384(%rsp)
	vsubss	%xmm0, %xmm10, %xmm8
	vmulss	%xmm1, %xmm24, %xmm5
	vmulss	%xmm1, %xmm25, %xmm7
	vsubss	%xmm2, %xmm10, %xmm9
	vmulss	%xmm1, %xmm26, %xmm1
	vaddss	%xmm3, %xmm10, %xmm3
	vaddss	%xmm2, %xmm10, %xmm2
	vmulss	%xmm4, %xmm25, %xmm11
	vaddss	%xmm0, %xmm10, %xmm0
	vmulss	%xmm4, %xmm24, %xmm10
	vmulss	%xmm4, %xmm26, %xmm4
	vmulss	%xmm8, %xmm24, %xmm15
	vaddss	%xmm5, %xmm29, %xmm5
	vmulss	%xmm8, %xmm25, %xmm16
	vaddss	%xmm7, %xmm28, %xmm7
	vmulss	%xmm8, %xmm26, %xmm8
	vmulss	%xmm9, %xmm24, %xmm17
	vmulss	%xmm9, %xmm25, %xmm18
	vmulss	%xmm9, %xmm26, %xmm9
	vmulss	%xmm3, %xmm24, %xmm19
	vmulss	%xmm3, %xmm25, %xmm21
	vmulss	%xmm2, %xmm24, %xmm22
	vmulss	%xmm2, %xmm25, %xmm23
	vmulss	%xmm3, %xmm26, %xmm3
	vmulss	%xmm0, %xmm24, %xmm24
	vaddss	%xmm1, %xmm12, %xmm1
	vmulss	%xmm0, %xmm25, %xmm25
	vmulss	%xmm0, %xmm26, %xmm0
	vmulss	%xmm2, %xmm26, %xmm2
	vaddss	%xmm4, %xmm12, %xmm4
	vaddss	%xmm10, %xmm29, %xmm10
	vaddss	%xmm11, %xmm28, %xmm11
	vaddss	%xmm15, %xmm29, %xmm15
	vmulss	%xmm5, %xmm5, %xmm26
	vaddss	%xmm16, %xmm28, %xmm16
	vaddss	%xmm8, %xmm12, %xmm8
	vaddss	%xmm17, %xmm29, %xmm17
	vaddss	%xmm18, %xmm28, %xmm18
	vmulss	%xmm1, %xmm1, %xmm27
	vaddss	%xmm0, %xmm12, %xmm0
	vmulss	%xmm4, %xmm4, %xmm5
	vmulss	%xmm7, %xmm7, %xmm7
	vaddss	%xmm9, %xmm12, %xmm9
	vaddss	%xmm19, %xmm29, %xmm19
	vaddss	%xmm21, %xmm28, %xmm21
	vaddss	%xmm22, %xmm29, %xmm22
	vaddss	%xmm24, %xmm29, %xmm24
	vaddss	%xmm23, %xmm28, %xmm23
	vmovaps	%xmm28, %xmm1
	vaddss	%xmm2, %xmm12, %xmm28
	vaddss	%xmm25, %xmm1, %xmm25
	vaddss	%xmm3, %xmm12, %xmm3
	vmovss	%xmm1, 320(%rsp)
	vmulss	%xmm10, %xmm10, %xmm1
	vmulss	%xmm11, %xmm11, %xmm2
	vmulss	%xmm13, %xmm26, %xmm4
	vmulss	%xmm15, %xmm15, %xmm15
	vmulss	%xmm18, %xmm18, %xmm18
	vmulss	%xmm0, %xmm0, %xmm31
	vmulss	%xmm7, %xmm13, %xmm10
	vmulss	%xmm13, %xmm27, %xmm11
	vaddss	%xmm7, %xmm26, %xmm29
	vmulss	%xmm16, %xmm16, %xmm16
	vmulss	%xmm8, %xmm8, %xmm8
	vmulss	%xmm17, %xmm17, %xmm17
	vmulss	%xmm3, %xmm3, %xmm30
	vmulss	%xmm9, %xmm9, %xmm9
	vmulss	%xmm19, %xmm19, %xmm19
	vmulss	%xmm21, %xmm21, %xmm21
	vmulss	%xmm22, %xmm22, %xmm22
	vmulss	%xmm28, %xmm28, %xmm28
	vmulss	%xmm23, %xmm23, %xmm23
	vmulss	%xmm24, %xmm24, %xmm24
	vmulss	%xmm25, %xmm25, %xmm25
	vsubss	%xmm7, %xmm4, %xmm0
	vmulss	%xmm13, %xmm15, %xmm7
	vsubss	%xmm27, %xmm10, %xmm4
	vsubss	%xmm26, %xmm11, %xmm10
	vaddss	%xmm29, %xmm27, %xmm3
	vmulss	%xmm13, %xmm16, %xmm11
	vmulss	%xmm13, %xmm18, %xmm12
	vaddss	%xmm16, %xmm15, %xmm27
	vmulss	%xmm13, %xmm8, %xmm26
	vmulss	%xmm13, %xmm17, %xmm29
	vsubss	%xmm16, %xmm7, %xmm16
	vaddss	%xmm18, %xmm17, %xmm7
	vsubss	%xmm8, %xmm11, %xmm11
	vmulss	%xmm4, %xmm0, %xmm14
	vmulss	%xmm13, %xmm9, %xmm4
	vsubss	%xmm15, %xmm26, %xmm0
	vmulss	%xmm13, %xmm19, %xmm15
	vaddss	%xmm27, %xmm8, %xmm8
	vsubss	%xmm9, %xmm12, %xmm12
	vsubss	%xmm18, %xmm29, %xmm18
	vmulss	%xmm13, %xmm21, %xmm26
	vaddss	%xmm7, %xmm9, %xmm27
	vaddss	%xmm21, %xmm19, %xmm9
	vsubss	%xmm17, %xmm4, %xmm4
	vmulss	%xmm13, %xmm30, %xmm17
	vsubss	%xmm21, %xmm15, %xmm15
	vmulss	%xmm13, %xmm22, %xmm21
	vmulss	%xmm11, %xmm16, %xmm11
	vmulss	%xmm12, %xmm18, %xmm12
	vaddss	%xmm9, %xmm30, %xmm29
	vmulss	%xmm13, %xmm28, %xmm9
	vsubss	%xmm19, %xmm17, %xmm7
	vmulss	%xmm13, %xmm23, %xmm17
	vsubss	%xmm23, %xmm21, %xmm21
	vaddss	%xmm23, %xmm22, %xmm23
	vsubss	%xmm30, %xmm26, %xmm19
	vmulss	%xmm13, %xmm31, %xmm26
	vmulss	%xmm0, %xmm11, %xmm0
	vmulss	%xmm4, %xmm12, %xmm4
	vsubss	%xmm22, %xmm9, %xmm9
	vmulss	%xmm13, %xmm24, %xmm22
	vsubss	%xmm28, %xmm17, %xmm17
	vaddss	%xmm23, %xmm28, %xmm23
	vsubss	%xmm24, %xmm26, %xmm28
	vaddss	%xmm25, %xmm24, %xmm24
	vmulss	%xmm19, %xmm15, %xmm15
	vsubss	%xmm25, %xmm22, %xmm30
	vmulss	%xmm13, %xmm25, %xmm22
	vaddss	%xmm24, %xmm31, %xmm24
	vmulss	%xmm17, %xmm21, %xmm17
	vmulss	%xmm7, %xmm15, %xmm7
	vsubss	%xmm31, %xmm22, %xmm25
	vmulss	%xmm13, %xmm5, %xmm22
	vmulss	%xmm17, %xmm9, %xmm9
	vsubss	%xmm1, %xmm22, %xmm31
	vmulss	%xmm13, %xmm1, %xmm22
	vaddss	%xmm2, %xmm1, %xmm1
	vmulss	%xmm25, %xmm30, %xmm21
	vsubss	%xmm2, %xmm22, %xmm22
	vmulss	%xmm2, %xmm13, %xmm2
	vmovss	(%rsi), %xmm13
	movabsq	$.LCPI0_10, %rsi
	vaddss	%xmm1, %xmm5, %xmm1
	vsubss	%xmm5, %xmm2, %xmm2
	vmulss	%xmm14, %xmm10, %xmm5
	vmovss	(%rsi), %xmm10
	movabsq	$.LCPI0_12, %rsi
	vmovss	(%rsi), %xmm14
	movabsq	$.LCPI0_4, %rsi
	vbroadcastss	(%rsi), %xmm26
	vmulss	%xmm2, %xmm22, %xmm2
	vaddss	%xmm3, %xmm13, %xmm3
	vaddss	%xmm1, %xmm13, %xmm1
	vaddss	%xmm13, %xmm8, %xmm8
	vaddss	%xmm13, %xmm23, %xmm19
	vaddss	%xmm13, %xmm27, %xmm16
	vaddss	%xmm13, %xmm29, %xmm18
	vaddss	%xmm13, %xmm24, %xmm23
	vmovss	%xmm13, 1984(%rsp)
	vmulss	%xmm2, %xmm31, %xmm2
	vmulss	%xmm3, %xmm3, %xmm3
	vmulss	%xmm1, %xmm1, %xmm1
	vmulss	%xmm5, %xmm10, %xmm5
	vmulss	%xmm8, %xmm8, %xmm8
	vmulss	%xmm16, %xmm16, %xmm11
	vmulss	%xmm18, %xmm18, %xmm12
	vmulss	%xmm19, %xmm19, %xmm15
	vmulss	%xmm21, %xmm28, %xmm16
	vmulss	%xmm23, %xmm23, %xmm17
	vmulss	%xmm0, %xmm10, %xmm0
	vmulss	%xmm7, %xmm10, %xmm7
	vmulss	%xmm10, %xmm9, %xmm9
	vmulss	%xmm2, %xmm10, %xmm2
	vmulss	%xmm3, %xmm14, %xmm3
	vmulss	%xmm1, %xmm14, %xmm1
	vsubss	%xmm3, %xmm5, %xmm13
	vmulss	%xmm14, %xmm8, %xmm3
	vmulss	%xmm4, %xmm10, %xmm5
	vmulss	%xmm14, %xmm11, %xmm8
	vmulss	%xmm14, %xmm12, %xmm11
	vmulss	%xmm14, %xmm15, %xmm12
	vmulss	%xmm10, %xmm16, %xmm10
	vmulss	%xmm14, %xmm17, %xmm14
	vsubss	%xmm1, %xmm2, %xmm4
	vsubss	%xmm3, %xmm0, %xmm1
	vxorps	%xmm26, %xmm13, %xmm0
	vsubss	%xmm14, %xmm10, %xmm31
	vsubss	%xmm12, %xmm9, %xmm29
	vsubss	%xmm8, %xmm5, %xmm3
	vsubss	%xmm13, %xmm4, %xmm19
	vaddss	%xmm4, %xmm13, %xmm5
	vsubss	%xmm11, %xmm7, %xmm28
	vmovups	%xmm13, 448(%rsp)
	vucomiss	%xmm13, %xmm0
	vsubss	%xmm4, %xmm5, %xmm7
	vsubss	%xmm4, %xmm19, %xmm12
	vaddss	%xmm1, %xmm31, %xmm8
	vsubss	%xmm1, %xmm31, %xmm10
	vmulss	%xmm20, %xmm5, %xmm11
	vmulss	%xmm20, %xmm19, %xmm14
	vxorps	%xmm26, %xmm3, %xmm2
	vaddss	%xmm3, %xmm29, %xmm27
	vxorps	%xmm26, %xmm1, %xmm15
	vsubss	%xmm3, %xmm29, %xmm9
	vaddss	%xmm6, %xmm28, %xmm26
	seta	%sil
	vucomiss	%xmm31, %xmm6
	vsubss	%xmm7, %xmm5, %xmm16
	vsubss	%xmm12, %xmm19, %xmm18
	vsubss	%xmm12, %xmm0, %xmm0
	vsubss	%xmm7, %xmm13, %xmm17
	vsubss	%xmm5, %xmm11, %xmm7
	vsubss	%xmm19, %xmm14, %xmm12
	vmulss	%xmm20, %xmm8, %xmm23
	vsubss	%xmm31, %xmm10, %xmm24
	vsubss	%xmm31, %xmm8, %xmm21
	vxorps	%xmm13, %xmm13, %xmm13
	setbe	%r9b
	vsubss	%xmm16, %xmm4, %xmm16
	vsubss	%xmm18, %xmm4, %xmm4
	vsubss	%xmm7, %xmm11, %xmm7
	vsubss	%xmm12, %xmm14, %xmm11
	vmulss	%xmm20, %xmm27, %xmm14
	vmulss	%xmm20, %xmm10, %xmm18
	vsubss	%xmm29, %xmm27, %xmm12
	xorb	%sil, %r9b
	vucomiss	%xmm29, %xmm6
	kmovd	%r9d, %k1
	movabsq	$.LCPI0_2, %r9
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	%xmm16, %xmm17, %xmm30
	vsubss	%xmm24, %xmm15, %xmm17
	vsubss	%xmm29, %xmm9, %xmm16
	setbe	%r15b
	xorb	%sil, %r15b
	vucomiss	%xmm28, %xmm6
	vmovups	%xmm0, 1024(%rsp)
	vsubss	%xmm8, %xmm23, %xmm0
	kmovd	%r15d, %k2
	vsubss	%xmm0, %xmm23, %xmm4
	vsubss	%xmm21, %xmm8, %xmm0
	setbe	%dil
	xorb	%sil, %dil
	vucomiss	%xmm3, %xmm2
	vsubss	%xmm16, %xmm2, %xmm2
	vsubss	%xmm12, %xmm3, %xmm3
	vsubss	%xmm12, %xmm27, %xmm12
	vsubss	%xmm12, %xmm29, %xmm12
	setbe	%r8b
	xorb	%sil, %r8b
	vucomiss	%xmm1, %xmm15
	vsubss	%xmm24, %xmm10, %xmm15
	vsubss	%xmm21, %xmm1, %xmm1
	vsubss	%xmm0, %xmm31, %xmm21
	vsubss	%xmm10, %xmm18, %xmm0
	vaddss	%xmm12, %xmm3, %xmm25
	vsubss	%xmm15, %xmm31, %xmm23
	vsubss	%xmm27, %xmm14, %xmm15
	vsubss	%xmm0, %xmm18, %xmm0
	vmovups	%xmm25, 640(%rsp)
	vsubss	%xmm15, %xmm14, %xmm24
	vsubss	%xmm16, %xmm9, %xmm15
	vmulss	%xmm20, %xmm9, %xmm14
	vsubss	%xmm15, %xmm29, %xmm16
	vsubss	%xmm9, %xmm14, %xmm15
	vmovups	%xmm24, 1664(%rsp)
	vmovaps	%xmm30, %xmm29
	vsubss	%xmm15, %xmm14, %xmm15
	vsubss	%xmm28, %xmm26, %xmm14
	vaddss	%xmm16, %xmm2, %xmm2
	vsubss	%xmm14, %xmm26, %xmm18
	vsubss	%xmm14, %xmm6, %xmm3
	vmovups	%xmm2, 1536(%rsp)
	vbroadcastss	%xmm7, %xmm2
	vsubss	%xmm18, %xmm28, %xmm18
	vaddss	%xmm21, %xmm1, %xmm28
	vmulss	%xmm20, %xmm26, %xmm1
	vsubss	%xmm26, %xmm1, %xmm21
	vaddss	%xmm18, %xmm3, %xmm20
	vsubss	%xmm7, %xmm5, %xmm3
	vmovups	%xmm28, 3328(%rsp)
	vsubss	%xmm21, %xmm1, %xmm22
	vaddss	%xmm23, %xmm17, %xmm1
	vmovups	(%rbx), %xmm17
	movabsq	$.LCPI0_48, %rbx
	vbroadcastss	%xmm3, %xmm16
	vmovups	%xmm20, 1856(%rsp)
	vmovups	(%rbx), %xmm12
	movabsq	$.LCPI0_46, %rbx
	vbroadcastss	%xmm1, %xmm1
	vmovups	%xmm22, 1728(%rsp)
	vmulps	%xmm17, %xmm2, %xmm14
	vmulps	%xmm17, %xmm16, %xmm17
	vmulps	%xmm2, %xmm12, %xmm2
	vmulps	%xmm12, %xmm16, %xmm12
	vbroadcastss	%xmm5, %xmm16
	vmovups	%xmm12, 1280(%rsp)
	vmovups	(%rbx), %xmm12
	movabsq	$.LCPI0_49, %rbx
	vmulps	%xmm12, %xmm16, %xmm18
	vsubps	%xmm14, %xmm18, %xmm14
	vsubps	%xmm17, %xmm14, %xmm14
	vsubps	%xmm2, %xmm14, %xmm2
	vmovups	%xmm2, 1088(%rsp)
	vaddps	%xmm13, %xmm18, %xmm2
	vsubps	%xmm2, %xmm18, %xmm14
	vsubps	%xmm2, %xmm2, %xmm17
	vsubss	%xmm4, %xmm8, %xmm18
	vaddps	%xmm17, %xmm14, %xmm14
	vmovups	%xmm14, 1792(%rsp)
	vbroadcastss	%xmm30, %xmm14
	vmulps	%xmm12, %xmm14, %xmm12
	vmulps	(%rbx), %xmm16, %xmm14
	movabsq	$.LCPI0_51, %rbx
	vbroadcastss	%xmm4, %xmm16
	vaddps	%xmm14, %xmm12, %xmm12
	vmovups	%xmm12, 768(%rsp)
	vmovups	(%rbx), %xmm12
	movabsq	$.LCPI0_52, %rbx
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_50, %rbx
	vmulps	%xmm12, %xmm16, %xmm17
	vmulps	%xmm14, %xmm16, %xmm16
	vmovups	%xmm16, 2496(%rsp)
	vbroadcastss	%xmm18, %xmm16
	vmulps	%xmm14, %xmm16, %xmm14
	vmulps	%xmm12, %xmm16, %xmm12
	vbroadcastss	%xmm8, %xmm16
	vmovups	%xmm14, 1216(%rsp)
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_53, %rbx
	vmulps	%xmm14, %xmm16, %xmm21
	vsubps	%xmm17, %xmm21, %xmm17
	vsubps	%xmm12, %xmm17, %xmm12
	vmovups	%xmm12, 2368(%rsp)
	vaddps	%xmm21, %xmm2, %xmm12
	vsubps	%xmm2, %xmm12, %xmm17
	vsubps	%xmm12, %xmm17, %xmm23
	vsubps	%xmm17, %xmm21, %xmm17
	vaddps	%xmm23, %xmm2, %xmm2
	vaddps	%xmm2, %xmm17, %xmm2
	vmovups	%xmm2, 1600(%rsp)
	vbroadcastss	%xmm28, %xmm2
	vsubss	%xmm24, %xmm27, %xmm28
	vmulps	%xmm2, %xmm14, %xmm2
	vmulps	(%rbx), %xmm16, %xmm14
	movabsq	$.LCPI0_55, %rbx
	vbroadcastss	%xmm28, %xmm21
	vaddps	%xmm2, %xmm14, %xmm2
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_56, %rbx
	vmovups	(%rbx), %xmm16
	movabsq	$.LCPI0_54, %rbx
	vmovups	%xmm2, 1152(%rsp)
	vbroadcastss	%xmm24, %xmm2
	vmulps	%xmm14, %xmm2, %xmm17
	vmulps	%xmm14, %xmm21, %xmm14
	vmulps	%xmm16, %xmm2, %xmm2
	vmovups	%xmm2, 544(%rsp)
	vmulps	%xmm16, %xmm21, %xmm2
	vmovups	(%rbx), %xmm16
	vbroadcastss	%xmm27, %xmm21
	movabsq	$.LCPI0_57, %rbx
	vmovups	%xmm2, 2432(%rsp)
	vmulps	%xmm16, %xmm21, %xmm23
	vsubps	%xmm17, %xmm23, %xmm17
	vaddps	%xmm23, %xmm12, %xmm24
	vsubps	%xmm14, %xmm17, %xmm2
	vsubps	%xmm12, %xmm24, %xmm14
	vsubps	%xmm24, %xmm14, %xmm17
	vmovups	%xmm2, 3264(%rsp)
	vaddps	%xmm17, %xmm12, %xmm2
	vbroadcastss	%xmm25, %xmm12
	vmulps	%xmm16, %xmm12, %xmm12
	vbroadcastss	%xmm22, %xmm16
	vmovups	%xmm2, 3200(%rsp)
	vsubps	%xmm14, %xmm23, %xmm2
	vmulps	(%rbx), %xmm21, %xmm14
	movabsq	$.LCPI0_59, %rbx
	vsubss	%xmm22, %xmm26, %xmm23
	vbroadcastss	%xmm26, %xmm21
	vmovups	%xmm2, 3136(%rsp)
	vaddps	%xmm14, %xmm12, %xmm2
	vmovups	(%rbx), %xmm12
	movabsq	$.LCPI0_60, %rbx
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_58, %rbx
	vmovups	%xmm2, 2304(%rsp)
	vmulps	%xmm12, %xmm16, %xmm17
	vmulps	%xmm14, %xmm16, %xmm2
	vbroadcastss	%xmm23, %xmm16
	vmulps	%xmm12, %xmm16, %xmm12
	vmovups	%xmm2, 3072(%rsp)
	vmulps	%xmm14, %xmm16, %xmm2
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_61, %rbx
	vmovups	%xmm2, 3392(%rsp)
	vmulps	%xmm14, %xmm21, %xmm16
	vsubps	%xmm17, %xmm16, %xmm17
	vsubps	%xmm12, %xmm17, %xmm2
	vbroadcastss	%xmm20, %xmm12
	vmulps	%xmm14, %xmm12, %xmm12
	vmulps	(%rbx), %xmm21, %xmm14
	movabsq	$.LCPI0_63, %rbx
	vmovups	%xmm2, 2240(%rsp)
	vaddps	%xmm14, %xmm12, %xmm2
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_64, %rbx
	vsubss	%xmm11, %xmm19, %xmm12
	vbroadcastss	%xmm11, %xmm11
	vmovups	(%rbx), %xmm17
	movabsq	$.LCPI0_62, %rbx
	vbroadcastss	%xmm12, %xmm12
	vmovups	%xmm2, 3456(%rsp)
	vmulps	%xmm14, %xmm11, %xmm21
	vmulps	%xmm14, %xmm12, %xmm14
	vmulps	%xmm17, %xmm12, %xmm2
	vmulps	%xmm17, %xmm11, %xmm11
	vmovups	(%rbx), %xmm17
	vbroadcastss	%xmm19, %xmm12
	movabsq	$.LCPI0_65, %rbx
	vmovups	%xmm2, 240(%rsp)
	vmulps	%xmm17, %xmm12, %xmm19
	vmulps	(%rbx), %xmm12, %xmm12
	movabsq	$.LCPI0_67, %rbx
	vsubps	%xmm21, %xmm19, %xmm21
	vsubps	%xmm14, %xmm21, %xmm14
	vsubps	%xmm11, %xmm14, %xmm2
	vaddps	%xmm13, %xmm19, %xmm11
	vsubps	%xmm11, %xmm19, %xmm14
	vsubps	%xmm11, %xmm11, %xmm19
	vmovups	%xmm2, 2944(%rsp)
	vaddps	%xmm19, %xmm14, %xmm2
	vbroadcastss	1024(%rsp), %xmm14
	vmovups	%xmm2, 960(%rsp)
	vmulps	%xmm17, %xmm14, %xmm14
	vaddps	%xmm12, %xmm14, %xmm2
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_68, %rbx
	vsubss	%xmm0, %xmm10, %xmm12
	vbroadcastss	%xmm0, %xmm0
	vmovups	(%rbx), %xmm17
	movabsq	$.LCPI0_66, %rbx
	vmovups	%xmm2, 1472(%rsp)
	vmulps	%xmm14, %xmm0, %xmm21
	vmulps	%xmm17, %xmm0, %xmm0
	vmovups	%xmm0, 2112(%rsp)
	vbroadcastss	%xmm12, %xmm0
	vmulps	%xmm0, %xmm14, %xmm12
	vmulps	%xmm17, %xmm0, %xmm0
	vmovups	(%rbx), %xmm17
	vbroadcastss	%xmm10, %xmm14
	movabsq	$.LCPI0_69, %rbx
	vmovups	%xmm0, 3008(%rsp)
	vmulps	%xmm17, %xmm14, %xmm25
	vmulps	%xmm17, %xmm1, %xmm1
	vsubps	%xmm21, %xmm25, %xmm0
	vsubps	%xmm12, %xmm0, %xmm10
	vaddps	%xmm25, %xmm11, %xmm0
	vsubps	2112(%rsp), %xmm10, %xmm10
	vsubps	%xmm11, %xmm0, %xmm12
	vsubps	%xmm0, %xmm12, %xmm21
	vsubps	%xmm12, %xmm25, %xmm12
	vaddps	%xmm21, %xmm11, %xmm11
	vaddps	%xmm11, %xmm12, %xmm2
	vmulps	(%rbx), %xmm14, %xmm11
	movabsq	$.LCPI0_71, %rbx
	vmovups	(%rbx), %xmm12
	movabsq	$.LCPI0_72, %rbx
	vmovups	(%rbx), %xmm14
	movabsq	$.LCPI0_70, %rbx
	vmovups	%xmm2, 1024(%rsp)
	vaddps	%xmm1, %xmm11, %xmm1
	vbroadcastss	%xmm15, %xmm11
	vmulps	%xmm12, %xmm11, %xmm21
	vmulps	%xmm14, %xmm11, %xmm17
	vbroadcastss	%xmm9, %xmm11
	vmovups	%xmm1, 2176(%rsp)
	vsubss	%xmm15, %xmm9, %xmm1
	vmovups	(%rbx), %xmm9
	movabsq	$.LCPI0_22, %rbx
	vmovss	(%r14), %xmm15
	vbroadcastss	%xmm1, %xmm1
	vmulps	%xmm1, %xmm12, %xmm12
	vmulps	%xmm14, %xmm1, %xmm31
	vmulps	%xmm9, %xmm11, %xmm25
	vsubps	%xmm21, %xmm25, %xmm1
	vsubps	%xmm12, %xmm1, %xmm2
	vmovups	1920(%rsp), %xmm1
	vbroadcastss	1536(%rsp), %xmm12
	vsubps	%xmm17, %xmm2, %xmm2
	vsubps	%xmm2, %xmm31, %xmm2
	vmovss	(%r9), %xmm1 {%k1}
	movabsq	$.LCPI0_75, %r9
	kmovd	%edi, %k1
	movabsq	$.LCPI0_14, %rdi
	vmulps	%xmm9, %xmm12, %xmm30
	vmovss	(%r9), %xmm9
	movabsq	$.LCPI0_16, %r9
	vmovss	(%r9), %xmm14
	movabsq	$.LCPI0_18, %r9
	vmovss	%xmm1, %xmm15, %xmm15 {%k2}
	vmulss	%xmm7, %xmm9, %xmm12
	vmulss	(%r9), %xmm7, %xmm7
	vmulss	%xmm3, %xmm9, %xmm9
	movabsq	$.LCPI0_20, %r9
	vmulss	%xmm14, %xmm5, %xmm21
	vmulss	(%r9), %xmm5, %xmm5
	movabsq	$.LCPI0_21, %r9
	vaddss	%xmm12, %xmm21, %xmm12
	vaddss	%xmm6, %xmm21, %xmm13
	vaddss	%xmm9, %xmm12, %xmm9
	vaddss	%xmm7, %xmm9, %xmm12
	vsubss	%xmm13, %xmm21, %xmm7
	vsubss	%xmm13, %xmm13, %xmm9
	vaddss	%xmm9, %xmm7, %xmm21
	vmulss	%xmm14, %xmm29, %xmm7
	vaddss	%xmm7, %xmm5, %xmm14
	vmovss	(%r9), %xmm5
	vmovss	(%rbx), %xmm7
	movabsq	$.LCPI0_24, %r9
	vmulss	%xmm5, %xmm8, %xmm22
	vmulss	%xmm7, %xmm4, %xmm9
	vmulss	%xmm7, %xmm18, %xmm29
	vmulss	(%r9), %xmm8, %xmm8
	vmulss	3328(%rsp), %xmm5, %xmm5
	movabsq	$.LCPI0_73, %r9
	vmulps	(%r9), %xmm11, %xmm11
	movabsq	$.LCPI0_19, %r9
	vmulss	(%r9), %xmm3, %xmm3
	movabsq	$.LCPI0_76, %r9
	vaddss	%xmm9, %xmm22, %xmm9
	vmulss	(%r9), %xmm4, %xmm4
	vaddss	%xmm29, %xmm9, %xmm29
	vaddss	%xmm22, %xmm13, %xmm9
	vsubss	%xmm13, %xmm9, %xmm20
	vaddss	%xmm5, %xmm8, %xmm8
	vaddps	%xmm25, %xmm0, %xmm5
	vaddps	%xmm11, %xmm30, %xmm11
	vaddps	%xmm16, %xmm24, %xmm30
	vsubss	%xmm9, %xmm20, %xmm19
	vsubss	%xmm12, %xmm3, %xmm3
	vaddss	%xmm4, %xmm29, %xmm4
	vaddps	%xmm2, %xmm11, %xmm2
	vaddss	%xmm19, %xmm13, %xmm13
	vsubss	%xmm20, %xmm22, %xmm19
	vaddss	%xmm3, %xmm14, %xmm3
	vaddss	%xmm13, %xmm19, %xmm13
	vsubps	%xmm0, %xmm5, %xmm19
	vaddss	%xmm3, %xmm21, %xmm3
	vsubps	%xmm19, %xmm25, %xmm20
	vsubps	%xmm5, %xmm19, %xmm19
	vaddps	%xmm19, %xmm0, %xmm1
	vmovups	1280(%rsp), %xmm0
	vsubps	1088(%rsp), %xmm0, %xmm12
	vmovups	2368(%rsp), %xmm0
	vsubps	2496(%rsp), %xmm0, %xmm19
	vmovups	3264(%rsp), %xmm0
	vsubps	544(%rsp), %xmm0, %xmm22
	vmovups	3136(%rsp), %xmm0
	vaddps	%xmm1, %xmm20, %xmm1
	vmovss	(%rdi), %xmm20
	movabsq	$.LCPI0_23, %rdi
	vaddps	3200(%rsp), %xmm0, %xmm25
	vmovups	2240(%rsp), %xmm0
	vmulss	(%rdi), %xmm18, %xmm14
	vaddps	768(%rsp), %xmm12, %xmm12
	setbe	%dil
	vsubps	3072(%rsp), %xmm0, %xmm29
	vsubps	%xmm24, %xmm30, %xmm0
	xorb	%sil, %dil
	movabsq	$.LCPI0_15, %rsi
	vaddps	%xmm2, %xmm1, %xmm1
	vsubps	%xmm0, %xmm16, %xmm16
	vsubps	%xmm30, %xmm0, %xmm0
	vaddps	%xmm0, %xmm24, %xmm0
	vmovups	240(%rsp), %xmm24
	vsubps	2944(%rsp), %xmm24, %xmm24
	vmovss	%xmm15, %xmm15, %xmm17 {%k1} {z}
	vmovups	2432(%rsp), %xmm15
	kmovd	%r8d, %k1
	vsubss	%xmm4, %xmm14, %xmm4
	vmovups	1216(%rsp), %xmm14
	vaddps	%xmm0, %xmm16, %xmm16
	vmovss	%xmm17, %xmm20, %xmm20 {%k1}
	vaddps	1472(%rsp), %xmm24, %xmm0
	kmovd	%edi, %k1
	vaddss	%xmm4, %xmm8, %xmm4
	vaddps	1792(%rsp), %xmm12, %xmm8
	vaddss	%xmm4, %xmm13, %xmm4
	vsubps	%xmm22, %xmm15, %xmm17
	vmovups	3392(%rsp), %xmm15
	vsubps	%xmm19, %xmm14, %xmm14
	vaddps	1152(%rsp), %xmm14, %xmm12
	vaddps	2304(%rsp), %xmm17, %xmm14
	vaddps	960(%rsp), %xmm0, %xmm17
	vmovss	(%rsi), %xmm0
	movabsq	$.LCPI0_74, %rsi
	vaddps	1600(%rsp), %xmm12, %xmm11
	vsubps	%xmm29, %xmm15, %xmm18
	vmovups	3008(%rsp), %xmm15
	vmovss	%xmm20, %xmm0, %xmm0 {%k1}
	vaddps	%xmm14, %xmm25, %xmm12
	vaddps	%xmm11, %xmm8, %xmm2
	vsubps	%xmm10, %xmm15, %xmm10
	vaddps	2176(%rsp), %xmm10, %xmm10
	vaddps	3456(%rsp), %xmm18, %xmm15
	vaddps	%xmm2, %xmm12, %xmm2
	vmovups	528(%rsp), %xmm18
	vaddps	1024(%rsp), %xmm10, %xmm10
	vaddps	%xmm15, %xmm16, %xmm13
	vaddps	%xmm10, %xmm17, %xmm8
	vaddps	%xmm2, %xmm13, %xmm2
	vmovups	1664(%rsp), %xmm10
	vaddps	%xmm1, %xmm8, %xmm1
	vmovups	(%rsi), %ymm8
	vaddps	%xmm2, %xmm30, %xmm2
	movb	$63, %sil
	kmovd	%esi, %k1
	movabsq	$.LCPI0_25, %rsi
	vaddps	%xmm1, %xmm5, %xmm1
	vmulss	%xmm7, %xmm28, %xmm5
	vpermi2ps	%ymm1, %ymm2, %ymm8
	vmovss	(%rsi), %xmm2
	movabsq	$.LCPI0_26, %rsi
	vaddss	%xmm4, %xmm3, %xmm1
	vmulss	%xmm7, %xmm10, %xmm4
	vmovups	%ymm8, 6656(%rsp) {%k1}
	vmovss	(%rsi), %xmm8
	movabsq	$.LCPI0_27, %rsi
	vmovss	(%rsi), %xmm11
	movabsq	$.LCPI0_28, %rsi
	vmulss	%xmm2, %xmm27, %xmm3
	vmulss	640(%rsp), %xmm2, %xmm2
	vsubss	%xmm4, %xmm3, %xmm4
	vmulss	%xmm8, %xmm10, %xmm10
	vmulss	%xmm8, %xmm23, %xmm8
	vmulss	%xmm11, %xmm28, %xmm12
	vsubss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm3, %xmm9, %xmm5
	vaddss	%xmm4, %xmm10, %xmm4
	vsubss	%xmm9, %xmm5, %xmm10
	vsubss	%xmm5, %xmm10, %xmm13
	vsubss	%xmm10, %xmm3, %xmm3
	vsubss	%xmm4, %xmm12, %xmm4
	vaddss	%xmm13, %xmm9, %xmm9
	vaddss	%xmm3, %xmm9, %xmm3
	vmulss	(%rsi), %xmm27, %xmm9
	movabsq	$.LCPI0_29, %rsi
	vaddss	%xmm2, %xmm9, %xmm2
	vaddss	%xmm4, %xmm2, %xmm2
	vmovups	1728(%rsp), %xmm4
	vaddss	%xmm2, %xmm3, %xmm2
	vaddss	%xmm1, %xmm2, %xmm1
	vmovss	(%rsi), %xmm2
	movabsq	$.LCPI0_30, %rsi
	vmulss	%xmm4, %xmm11, %xmm3
	vmulss	%xmm7, %xmm4, %xmm4
	vmulss	%xmm7, %xmm23, %xmm7
	vmulss	%xmm2, %xmm26, %xmm9
	vmulss	1856(%rsp), %xmm2, %xmm2
	vaddss	%xmm4, %xmm9, %xmm4
	vaddss	%xmm5, %xmm9, %xmm10
	vaddss	%xmm7, %xmm4, %xmm4
	vsubss	%xmm5, %xmm10, %xmm7
	vaddss	%xmm3, %xmm4, %xmm3
	vsubss	%xmm3, %xmm8, %xmm3
	vsubss	%xmm10, %xmm7, %xmm8
	vsubss	%xmm7, %xmm9, %xmm7
	vaddss	%xmm5, %xmm8, %xmm5
	vmulss	(%rsi), %xmm26, %xmm8
	movabsq	$.LCPI0_31, %rsi
	vaddss	%xmm5, %xmm7, %xmm5
	vaddss	%xmm2, %xmm8, %xmm2
	vaddss	%xmm3, %xmm2, %xmm2
	vaddss	%xmm2, %xmm5, %xmm2
	vaddss	%xmm1, %xmm2, %xmm1
	vmovaps	%xmm0, %xmm2
	vaddss	%xmm1, %xmm10, %xmm23
	vmulss	(%rsi), %xmm23, %xmm1
	vmovss	%xmm23, 6680(%rsp)
	vmovss	6676(%rsp), %xmm3
	vucomiss	%xmm6, %xmm1
	jne	.LBB0_40
	jnp	.LBB0_41
.LBB0_40:
	vxorps	%xmm18, %xmm3, %xmm2
	movabsq	$.LCPI0_11, %rsi
	vdivss	%xmm1, %xmm2, %xmm1
	vmaxss	(%rsi), %xmm1, %xmm1
	vminss	%xmm0, %xmm1, %xmm2
.LBB0_41:
	vmovss	2816(%rsp), %xmm13
	vmovss	2752(%rsp), %xmm14
	vmovss	2688(%rsp), %xmm20
	vmovss	48(%rsp), %xmm19
	vmovss	2624(%rsp), %xmm21
	vmovss	1408(%rsp), %xmm24
	vmovss	896(%rsp), %xmm25
	vmovss	832(%rsp), %xmm30
	vmovss	704(%rsp), %xmm31
	vmovups	448(%rsp), %xmm28
	vmovss	1984(%rsp), %xmm22
	movl	$2, %esi
	vmovss	%xmm2, 3972(%rsp)
	vmovss	%xmm0, 3976(%rsp)
	jmp	.LBB0_42
	.p2align	4
.LBB0_48:
	incq	%rsi
	cmpq	$6, %rsi
	je	.LBB0_49
.LBB0_42:
	leaq	(,%rsi,8), %rdi
	leaq	(,%rsi,4), %r8
	movabsq	$FACTORS, %r15
	movl	$1, %r9d
	leaq	-2(%rsi), %rbx
	subq	%rsi, %r9
	shlq	$2, %rbx
	subq	%rsi, %rdi
	negq	%r8
	negq	%rbx
	vmovss	(%r15,%rdi,4), %xmm0
	vmovss	4(%r15,%rdi,4), %xmm1
	vmulss	6680(%rsp,%r8), %xmm0, %xmm0
	vmovss	%xmm0, 5312(%rsp)
	vmulss	6680(%rsp,%r9,4), %xmm1, %xmm0
	vmovss	%xmm0, 5316(%rsp)
	vmovss	8(%r15,%rdi,4), %xmm0
	vmulss	6680(%rsp,%rbx), %xmm0, %xmm0
	vmovss	%xmm0, 5320(%rsp)
	cmpq	$2, %rsi
	je	.LBB0_46
	leaq	-3(%rsi), %r8
	vmovss	12(%r15,%rdi,4), %xmm0
	shlq	$2, %r8
	negq	%r8
	vmulss	6680(%rsp,%r8), %xmm0, %xmm0
	vmovss	%xmm0, 5324(%rsp)
	cmpq	$3, %rsi
	je	.LBB0_46
	leaq	-4(%rsi), %r8
	vmovss	16(%r15,%rdi,4), %xmm0
	shlq	$2, %r8
	negq	%r8
	vmulss	6680(%rsp,%r8), %xmm0, %xmm0
	vmovss	%xmm0, 5328(%rsp)
	cmpq	$4, %rsi
	je	.LBB0_46
	vmovss	20(%r15,%rdi,4), %xmm0
	movl	$5, %edi
	subq	%rsi, %rdi
	vmulss	6680(%rsp,%rdi,4), %xmm0, %xmm0
	vmovss	%xmm0, 5332(%rsp)
	.p2align	4
.LBB0_46:
	vmovss	5312(%rsp,%rsi,4), %xmm1
	vmovss	5308(%rsp,%rsi,4), %xmm4
	vmovss	5304(%rsp,%rsi,4), %xmm2
	vsubss	%xmm1, %xmm4, %xmm0
	vsubss	%xmm0, %xmm2, %xmm0
	cmpq	$2, %rsi
	jbe	.LBB0_47
	movq	%rsi, %rdi
	subq	$3, %rdi
	vmovss	5312(%rsp,%rdi,4), %xmm5
	vsubss	%xmm0, %xmm5, %xmm0
	je	.LBB0_56
	vmovss	5296(%rsp,%rsi,4), %xmm5
	vsubss	%xmm0, %xmm5, %xmm0
	cmpq	$5, %rsi
	jb	.LBB0_56
	vmovss	5292(%rsp,%rsi,4), %xmm5
	vsubss	%xmm0, %xmm5, %xmm0
	jmp	.LBB0_56
	.p2align	4
.LBB0_47:
	leaq	-3(%rsi), %rdi
.LBB0_56:
	vmovss	3968(%rsp,%rsi,4), %xmm5
	movl	$1, %r8d
	vmovaps	%xmm22, %xmm8
	vmovss	%xmm5, 3972(%rsp,%rsi,4)
	jmp	.LBB0_57
	.p2align	4
.LBB0_63:
	vmovaps	%xmm9, %xmm11
.LBB0_64:
	vmovss	%xmm11, 3968(%rsp,%r8,4)
.LBB0_65:
	vmovaps	%xmm5, %xmm8
	vmovaps	%xmm7, %xmm0
	cmpq	%rsi, %r8
	leaq	1(%r8), %r8
	je	.LBB0_48
.LBB0_57:
	vmovss	3968(%rsp,%r8,4), %xmm5
	vmulss	%xmm1, %xmm5, %xmm7
	vaddss	%xmm4, %xmm7, %xmm7
	vmulss	%xmm7, %xmm5, %xmm7
	vaddss	%xmm2, %xmm7, %xmm7
	cmpq	$3, %rsi
	jb	.LBB0_61
	vmulss	%xmm7, %xmm5, %xmm7
	vaddss	5312(%rsp,%rdi,4), %xmm7, %xmm7
	jbe	.LBB0_61
	vmulss	%xmm7, %xmm5, %xmm7
	vaddss	5296(%rsp,%rsi,4), %xmm7, %xmm7
	cmpq	$5, %rsi
	jb	.LBB0_61
	vmulss	%xmm7, %xmm5, %xmm7
	vaddss	5292(%rsp,%rsi,4), %xmm7, %xmm7
	.p2align	4
.LBB0_61:
	vcmpnltss	%xmm6, %xmm7, %k0
	vcmpltss	%xmm6, %xmm0, %k1
	kxorw	%k0, %k1, %k0
	kmovd	%k0, %r9d
	testb	$1, %r9b
	jne	.LBB0_65
	vaddss	%xmm7, %xmm0, %xmm11
	vmulss	(%r11), %xmm11, %xmm11
	vsubss	%xmm7, %xmm0, %xmm12
	vaddss	%xmm5, %xmm8, %xmm9
	vmulss	(%r14), %xmm9, %xmm9
	vsubss	%xmm8, %xmm5, %xmm10
	vucomiss	(%rdx), %xmm10
	vdivss	%xmm12, %xmm11, %xmm11
	vmulss	%xmm11, %xmm10, %xmm11
	vaddss	%xmm11, %xmm9, %xmm9
	jbe	.LBB0_63
	vinsertps	$16, %xmm10, %xmm9, %xmm10
	vinsertps	$16, %xmm5, %xmm8, %xmm8
	xorl	%r9d, %r9d
	.p2align	4
.LBB0_67:
	vmulss	%xmm6, %xmm9, %xmm11
	vmulss	%xmm1, %xmm9, %xmm12
	vaddss	%xmm1, %xmm11, %xmm11
	vaddss	%xmm4, %xmm12, %xmm12
	vmulss	%xmm11, %xmm9, %xmm11
	vaddss	%xmm11, %xmm12, %xmm11
	vmulss	%xmm12, %xmm9, %xmm12
	vaddss	%xmm2, %xmm12, %xmm15
	cmpq	$3, %rsi
	jb	.LBB0_71
	vmulss	%xmm11, %xmm9, %xmm11
	vmulss	%xmm15, %xmm9, %xmm12
	vaddss	%xmm11, %xmm15, %xmm11
	vaddss	5312(%rsp,%rdi,4), %xmm12, %xmm15
	jbe	.LBB0_71
	vmulss	%xmm11, %xmm9, %xmm11
	vmulss	%xmm15, %xmm9, %xmm12
	vaddss	%xmm11, %xmm15, %xmm11
	vaddss	5296(%rsp,%rsi,4), %xmm12, %xmm15
	cmpq	$5, %rsi
	jb	.LBB0_71
	vmulss	%xmm11, %xmm9, %xmm11
	vmulss	%xmm15, %xmm9, %xmm12
	vaddss	%xmm11, %xmm15, %xmm11
	vaddss	5292(%rsp,%rsi,4), %xmm12, %xmm15
	.p2align	4
.LBB0_71:
	vucomiss	%xmm0, %xmm6
	seta	%bl
	vucomiss	%xmm15, %xmm6
	setbe	%r15b
	cmpb	%bl, %r15b
	je	.LBB0_73
	vmovshdup	%xmm8, %xmm16
	vblendps	$2, %xmm8, %xmm10, %xmm8
	vmovaps	%xmm9, %xmm17
	jmp	.LBB0_74
	.p2align	4
.LBB0_73:
	vmovaps	%xmm8, %xmm17
	vinsertps	$28, %xmm10, %xmm8, %xmm8
	vmovaps	%xmm9, %xmm16
.LBB0_74:
	vdivss	%xmm11, %xmm15, %xmm10
	vsubss	%xmm10, %xmm9, %xmm11
	vaddss	%xmm17, %xmm16, %xmm10
	vmulss	(%r14), %xmm10, %xmm10
	vcmpnless	%xmm16, %xmm11, %k0
	vcmpnless	%xmm11, %xmm17, %k1
	korw	%k0, %k1, %k1
	vmovss	%xmm10, %xmm11, %xmm11 {%k1}
	cmpl	$62, %r9d
	ja	.LBB0_64
	vsubss	%xmm9, %xmm11, %xmm9
	vandps	(%rax){1to4}, %xmm9, %xmm9
	incl	%r9d
	vucomiss	(%rdx), %xmm9
	vinsertps	$16, %xmm9, %xmm11, %xmm10
	vmovaps	%xmm11, %xmm9
	ja	.LBB0_67
	jmp	.LBB0_64
	.p2align	4
.LBB0_49:
	movabsq	$.LCPI0_11, %r8
	vmovss	6660(%rsp), %xmm22
	vmovss	6664(%rsp), %xmm2
	vmovss	6668(%rsp), %xmm26
	vmovss	6672(%rsp), %xmm27
	vcmpltss	%xmm6, %xmm28, %k0
	vcmpnltss	%xmm6, %xmm28, %k1
	movl	$7, %esi
	vmovss	(%r8), %xmm1
	kxorw	%k0, %k1, %k1
	kmovd	%k1, %edi
	vmovaps	%xmm1, %xmm29
	testb	$1, %dil
	je	.LBB0_51
	vmovss	3972(%rsp), %xmm29
	vmovss	576(%rsp), %xmm9
	movabsq	$.LCPI0_11, %rdi
	movabsq	$.LCPI0_10, %rsi
	vmulss	256(%rsp), %xmm29, %xmm0
	vaddss	384(%rsp), %xmm0, %xmm0
	vmulss	%xmm0, %xmm25, %xmm5
	vaddss	320(%rsp), %xmm5, %xmm5
	vmulss	%xmm0, %xmm24, %xmm4
	vmulss	%xmm0, %xmm30, %xmm0
	vaddss	64(%rsp), %xmm0, %xmm0
	vaddss	%xmm4, %xmm31, %xmm4
	vmulss	%xmm4, %xmm4, %xmm4
	vmulss	%xmm4, %xmm9, %xmm7
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	%xmm5, %xmm9, %xmm8
	vsubss	%xmm5, %xmm7, %xmm7
	vsubss	%xmm0, %xmm8, %xmm8
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm9, %xmm8
	vsubss	%xmm4, %xmm8, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	(%rdi), %xmm0, %xmm0
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	(%rsi), %xmm7, %xmm7
	movabsq	$.LCPI0_45, %rsi
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	(%rsi), %xmm0, %xmm0
	movl	$8, %esi
	vaddss	%xmm0, %xmm7, %xmm28
.LBB0_51:
	vmovups	448(%rsp), %xmm10
	vucomiss	%xmm10, %xmm6
	seta	%dil
	vucomiss	%xmm28, %xmm6
	setbe	%r8b
	cmpb	%dil, %r8b
	je	.LBB0_52
	vmovaps	%xmm29, %xmm1
	vmovss	3976(%rsp), %xmm29
	vmovss	576(%rsp), %xmm9
	movabsq	$.LCPI0_11, %r8
	movabsq	$.LCPI0_10, %rdi
	incl	%esi
	vmulss	256(%rsp), %xmm29, %xmm0
	vaddss	384(%rsp), %xmm0, %xmm0
	vmulss	%xmm0, %xmm25, %xmm5
	vaddss	320(%rsp), %xmm5, %xmm5
	vmulss	%xmm0, %xmm24, %xmm4
	vmulss	%xmm0, %xmm30, %xmm0
	vaddss	64(%rsp), %xmm0, %xmm0
	vaddss	%xmm4, %xmm31, %xmm4
	vmulss	%xmm4, %xmm4, %xmm4
	vmulss	%xmm4, %xmm9, %xmm7
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	%xmm5, %xmm9, %xmm8
	vsubss	%xmm5, %xmm7, %xmm7
	vsubss	%xmm0, %xmm8, %xmm8
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm9, %xmm8
	vsubss	%xmm4, %xmm8, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	(%r8), %xmm0, %xmm0
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	(%rdi), %xmm7, %xmm7
	movabsq	$.LCPI0_45, %rdi
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	(%rdi), %xmm0, %xmm4
	vmovaps	%xmm28, %xmm0
	vaddss	%xmm4, %xmm7, %xmm28
	jmp	.LBB0_77
	.p2align	4
.LBB0_52:
	vmovaps	%xmm10, %xmm0
.LBB0_77:
	vucomiss	%xmm10, %xmm6
	seta	%dil
	vucomiss	%xmm28, %xmm6
	setbe	%r8b
	cmpb	%dil, %r8b
	je	.LBB0_79
	vmovaps	%xmm29, %xmm1
	vmovss	3980(%rsp), %xmm29
	vmovss	576(%rsp), %xmm9
	movabsq	$.LCPI0_11, %r8
	movabsq	$.LCPI0_10, %rdi
	incl	%esi
	vmulss	256(%rsp), %xmm29, %xmm0
	vaddss	384(%rsp), %xmm0, %xmm0
	vmulss	%xmm0, %xmm25, %xmm5
	vaddss	320(%rsp), %xmm5, %xmm5
	vmulss	%xmm0, %xmm24, %xmm4
	vmulss	%xmm0, %xmm30, %xmm0
	vaddss	64(%rsp), %xmm0, %xmm0
	vaddss	%xmm4, %xmm31, %xmm4
	vmulss	%xmm4, %xmm4, %xmm4
	vmulss	%xmm4, %xmm9, %xmm7
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	%xmm5, %xmm9, %xmm8
	vsubss	%xmm5, %xmm7, %xmm7
	vsubss	%xmm0, %xmm8, %xmm8
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm9, %xmm8
	vsubss	%xmm4, %xmm8, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	(%r8), %xmm0, %xmm0
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	(%rdi), %xmm7, %xmm7
	movabsq	$.LCPI0_45, %rdi
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	(%rdi), %xmm0, %xmm4
	vmovaps	%xmm28, %xmm0
	vaddss	%xmm4, %xmm7, %xmm28
.LBB0_79:
	vucomiss	448(%rsp), %xmm6
	seta	%dil
	vucomiss	%xmm28, %xmm6
	setbe	%r8b
	cmpb	%dil, %r8b
	je	.LBB0_81
	vmovaps	%xmm29, %xmm1
	vmovss	3984(%rsp), %xmm29
	vmovss	576(%rsp), %xmm9
	movabsq	$.LCPI0_11, %r8
	movabsq	$.LCPI0_10, %rdi
	incl	%esi
	vmulss	256(%rsp), %xmm29, %xmm0
	vaddss	384(%rsp), %xmm0, %xmm0
	vmulss	%xmm0, %xmm25, %xmm5
	vaddss	320(%rsp), %xmm5, %xmm5
	vmulss	%xmm0, %xmm24, %xmm4
	vmulss	%xmm0, %xmm30, %xmm0
	vaddss	64(%rsp), %xmm0, %xmm0
	vaddss	%xmm4, %xmm31, %xmm4
	vmulss	%xmm4, %xmm4, %xmm4
	vmulss	%xmm4, %xmm9, %xmm7
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	%xmm5, %xmm9, %xmm8
	vsubss	%xmm5, %xmm7, %xmm7
	vsubss	%xmm0, %xmm8, %xmm8
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm9, %xmm8
	vsubss	%xmm4, %xmm8, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	(%r8), %xmm0, %xmm0
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	(%rdi), %xmm7, %xmm7
	movabsq	$.LCPI0_45, %rdi
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	(%rdi), %xmm0, %xmm4
	vmovaps	%xmm28, %xmm0
	vaddss	%xmm4, %xmm7, %xmm28
.LBB0_81:
	vucomiss	448(%rsp), %xmm6
	seta	%dil
	vucomiss	%xmm28, %xmm6
	setbe	%r8b
	cmpb	%dil, %r8b
	je	.LBB0_83
	vmovaps	%xmm29, %xmm1
	vmovss	3988(%rsp), %xmm29
	vmovss	576(%rsp), %xmm9
	movabsq	$.LCPI0_11, %r8
	movabsq	$.LCPI0_10, %rdi
	incl	%esi
	vmulss	256(%rsp), %xmm29, %xmm0
	vaddss	384(%rsp), %xmm0, %xmm0
	vmulss	%xmm0, %xmm25, %xmm5
	vaddss	320(%rsp), %xmm5, %xmm5
	vmulss	%xmm0, %xmm24, %xmm4
	vmulss	%xmm0, %xmm30, %xmm0
	vaddss	64(%rsp), %xmm0, %xmm0
	vaddss	%xmm4, %xmm31, %xmm4
	vmulss	%xmm4, %xmm4, %xmm4
	vmulss	%xmm4, %xmm9, %xmm7
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	%xmm5, %xmm9, %xmm8
	vsubss	%xmm5, %xmm7, %xmm7
	vsubss	%xmm0, %xmm8, %xmm8
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm9, %xmm8
	vsubss	%xmm4, %xmm8, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	(%r8), %xmm0, %xmm0
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	(%rdi), %xmm7, %xmm7
	movabsq	$.LCPI0_45, %rdi
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	(%rdi), %xmm0, %xmm4
	vmovaps	%xmm28, %xmm0
	vaddss	%xmm4, %xmm7, %xmm28
.LBB0_83:
	vucomiss	448(%rsp), %xmm6
	seta	%dil
	vucomiss	%xmm28, %xmm6
	setbe	%r8b
	cmpb	%dil, %r8b
	je	.LBB0_85
	vmovaps	%xmm29, %xmm1
	vmovss	3992(%rsp), %xmm29
	vmovss	576(%rsp), %xmm9
	movabsq	$.LCPI0_11, %r8
	movabsq	$.LCPI0_10, %rdi
	incl	%esi
	vmulss	256(%rsp), %xmm29, %xmm0
	vaddss	384(%rsp), %xmm0, %xmm0
	vmulss	%xmm0, %xmm25, %xmm5
	vaddss	320(%rsp), %xmm5, %xmm5
	vmulss	%xmm0, %xmm24, %xmm4
	vmulss	%xmm0, %xmm30, %xmm0
	vaddss	64(%rsp), %xmm0, %xmm0
	vaddss	%xmm4, %xmm31, %xmm4
	vmulss	%xmm4, %xmm4, %xmm4
	vmulss	%xmm4, %xmm9, %xmm7
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	%xmm5, %xmm9, %xmm8
	vsubss	%xmm5, %xmm7, %xmm7
	vsubss	%xmm0, %xmm8, %xmm8
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	%xmm0, %xmm9, %xmm8
	vsubss	%xmm4, %xmm8, %xmm8
	vaddss	%xmm5, %xmm4, %xmm4
	vaddss	%xmm4, %xmm0, %xmm0
	vaddss	(%r8), %xmm0, %xmm0
	vmulss	%xmm7, %xmm8, %xmm7
	vmulss	(%rdi), %xmm7, %xmm7
	movabsq	$.LCPI0_45, %rdi
	vmulss	%xmm0, %xmm0, %xmm0
	vmulss	(%rdi), %xmm0, %xmm4
	vmovaps	%xmm28, %xmm0
	vaddss	%xmm4, %xmm7, %xmm28
.LBB0_85:
	vmovss	1344(%rsp), %xmm8
	vcmpnltss	%xmm6, %xmm28, %k1
	xorl	%edi, %edi
	kxorw	%k0, %k1, %k0
	kmovd	%k0, %r8d
	testb	$1, %r8b
	jne	.LBB0_94
	vaddss	%xmm28, %xmm0, %xmm7
	vmulss	(%r11), %xmm7, %xmm7
	vsubss	%xmm28, %xmm0, %xmm0
	vaddss	%xmm29, %xmm1, %xmm4
	vmulss	(%r14), %xmm4, %xmm5
	vsubss	%xmm1, %xmm29, %xmm4
	vmovss	256(%rsp), %xmm16
	movabsq	$.LCPI0_44, %rdi
	vmovss	384(%rsp), %xmm17
	vucomiss	(%rdi), %xmm4
	movl	$1, %edi
	vdivss	%xmm0, %xmm7, %xmm0
	vmulss	%xmm0, %xmm4, %xmm0
	vaddss	%xmm0, %xmm5, %xmm0
	vmulss	%xmm0, %xmm16, %xmm5
	vaddss	%xmm5, %xmm17, %xmm8
	jbe	.LBB0_94
	vmovss	320(%rsp), %xmm11
	vmovss	64(%rsp), %xmm12
	vmovss	576(%rsp), %xmm15
	vmovups	448(%rsp), %xmm28
	vinsertps	$16, %xmm4, %xmm0, %xmm4
	vinsertps	$16, %xmm29, %xmm1, %xmm1
	xorl	%r8d, %r8d
	.p2align	4
.LBB0_88:
	vmulss	%xmm8, %xmm24, %xmm5
	vmulss	%xmm8, %xmm25, %xmm7
	vmulss	%xmm8, %xmm30, %xmm8
	movabsq	$.LCPI0_11, %r15
	movabsq	$.LCPI0_10, %rbx
	vucomiss	%xmm28, %xmm6
	vaddss	%xmm5, %xmm31, %xmm5
	vaddss	%xmm7, %xmm11, %xmm7
	vaddss	%xmm8, %xmm12, %xmm8
	seta	%r9b
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	%xmm7, %xmm7, %xmm7
	vmulss	%xmm8, %xmm8, %xmm8
	vmulss	%xmm5, %xmm15, %xmm9
	vmulss	%xmm7, %xmm15, %xmm10
	vsubss	%xmm7, %xmm9, %xmm9
	vsubss	%xmm8, %xmm10, %xmm10
	vmulss	%xmm10, %xmm9, %xmm9
	vmulss	%xmm15, %xmm8, %xmm10
	vsubss	%xmm5, %xmm10, %xmm10
	vaddss	%xmm7, %xmm5, %xmm5
	vaddss	%xmm5, %xmm8, %xmm5
	vaddss	(%r15), %xmm5, %xmm5
	vmulss	%xmm9, %xmm10, %xmm9
	vmulss	(%rbx), %xmm9, %xmm9
	movabsq	$.LCPI0_45, %rbx
	vmulss	%xmm5, %xmm5, %xmm5
	vmulss	(%rbx), %xmm5, %xmm5
	vaddss	%xmm5, %xmm9, %xmm5
	vucomiss	%xmm5, %xmm6
	setbe	%bl
	cmpb	%r9b, %bl
	je	.LBB0_90
	vmovshdup	%xmm1, %xmm7
	vblendps	$2, %xmm1, %xmm4, %xmm1
	vmovaps	%xmm0, %xmm8
	jmp	.LBB0_91
	.p2align	4
.LBB0_90:
	vmovaps	%xmm1, %xmm8
	vinsertps	$28, %xmm4, %xmm1, %xmm1
	vmovaps	%xmm0, %xmm7
.LBB0_91:
	vmulss	%xmm6, %xmm0, %xmm4
	vmulss	%xmm0, %xmm23, %xmm9
	leal	1(%r8), %r9d
	vaddss	%xmm4, %xmm23, %xmm4
	vaddss	%xmm3, %xmm9, %xmm9
	vmulss	%xmm4, %xmm0, %xmm4
	vaddss	%xmm4, %xmm9, %xmm4
	vmulss	%xmm0, %xmm9, %xmm9
	vaddss	%xmm9, %xmm27, %xmm9
	vmulss	%xmm4, %xmm0, %xmm4
	vaddss	%xmm4, %xmm9, %xmm4
	vmulss	%xmm0, %xmm9, %xmm9
	vaddss	%xmm9, %xmm26, %xmm9
	vmulss	%xmm4, %xmm0, %xmm4
	vaddss	%xmm4, %xmm9, %xmm4
	vmulss	%xmm0, %xmm9, %xmm9
	vaddss	%xmm2, %xmm9, %xmm9
	vmulss	%xmm4, %xmm0, %xmm4
	vaddss	%xmm4, %xmm9, %xmm4
	vmulss	%xmm0, %xmm9, %xmm9
	vaddss	%xmm9, %xmm22, %xmm9
	vmulss	%xmm4, %xmm0, %xmm4
	vaddss	%xmm4, %xmm9, %xmm4
	vdivss	%xmm4, %xmm5, %xmm4
	vsubss	%xmm4, %xmm0, %xmm5
	vaddss	%xmm7, %xmm8, %xmm4
	vmulss	(%r14), %xmm4, %xmm4
	vcmpnless	%xmm7, %xmm5, %k0
	vcmpnless	%xmm5, %xmm8, %k1
	korw	%k0, %k1, %k1
	vmovss	%xmm4, %xmm5, %xmm5 {%k1}
	vmulss	%xmm5, %xmm16, %xmm4
	vaddss	%xmm4, %xmm17, %xmm8
	cmpl	$62, %r8d
	ja	.LBB0_93
	vsubss	%xmm0, %xmm5, %xmm0
	vandps	(%rax){1to4}, %xmm0, %xmm0
	movabsq	$.LCPI0_44, %r8
	vucomiss	(%r8), %xmm0
	movl	%r9d, %r8d
	vinsertps	$16, %xmm0, %xmm5, %xmm4
	vmovaps	%xmm5, %xmm0
	ja	.LBB0_88
	jmp	.LBB0_93
.LBB0_97:
	leaq	-40(%rbp), %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.LBB0_3:
	vcvtsi2ssl	184(%rsp), %xmm15, %xmm0
	movq	32(%rsp), %rcx
	movabsq	$.LCPI0_0, %rsi
	movabsq	$.LCPI0_39, %r8
	movabsq	$.LCPI0_40, %rbx
	vbroadcastss	(%r14), %zmm16
	movabsq	$.LCPI0_32, %r15
	vbroadcastss	(%rdx), %zmm27
	leaq	5632(%rsp), %r10
	movabsq	$.LCPI0_38, %r9
	vxorps	%xmm20, %xmm20, %xmm20
	movq	%r12, 208(%rsp)
	vmovups	(%r8), %zmm24
	movabsq	$.LCPI0_3, %r8
	vmovups	(%rbx), %zmm25
	vmovups	(%rsi), %zmm23
	movabsq	$EVEN_HI, %rbx
	vpbroadcastd	%ecx, %zmm1
	vmovss	%xmm0, 56(%rsp)
	vcvtsi2ssl	24(%rsp), %xmm15, %xmm0
	vbroadcastss	%xmm0, %zmm0
	vmovups	%zmm0, 2624(%rsp)
	vpaddd	%zmm1, %zmm1, %zmm0
	vpaddd	(%rsi), %zmm0, %zmm1
	movabsq	$EVEN_LO, %rsi
	vmovd	%xmm0, %edi
	vpextrd	$1, %xmm1, %ecx
	vmovdqu64	%zmm1, 3520(%rsp)
	vmovss	(%r8), %xmm1
	movq	192(%rsp), %r8
	subl	%edi, %ecx
	movw	$-21846, %di
	shll	$4, %ecx
	vpbroadcastd	%ecx, %zmm0
	movabsq	$.LCPI0_1, %rcx
	vbroadcastss	(%rcx), %zmm3
	movabsq	$.LCPI0_2, %rcx
	vmovdqu64	%zmm0, 2560(%rsp)
	vbroadcastss	(%rcx), %zmm2
	movabsq	$.LCPI0_3, %rcx
	vmovss	%xmm1, 60(%rsp)
	vmovups	%zmm3, 3904(%rsp)
	vbroadcastss	(%rcx), %zmm3
	movabsq	$.LCPI0_5, %rcx
	vmovups	%zmm2, 3840(%rsp)
	vbroadcastss	(%rcx), %zmm2
	movabsq	$.LCPI0_6, %rcx
	vmovups	%zmm3, 2112(%rsp)
	vbroadcastss	(%rcx), %zmm3
	movabsq	$.LCPI0_7, %rcx
	vmovups	%zmm2, 3776(%rsp)
	vbroadcastss	(%rcx), %zmm2
	movabsq	$.LCPI0_9, %rcx
	vmovups	%zmm3, 3712(%rsp)
	vbroadcastss	(%rcx), %zmm3
	movabsq	$.LCPI0_10, %rcx
	vmovups	%zmm2, 3648(%rsp)
	vbroadcastss	(%rcx), %zmm2
	movabsq	$.LCPI0_11, %rcx
	vmovups	%zmm3, 1600(%rsp)
	vbroadcastss	(%rcx), %zmm3
	movabsq	$.LCPI0_4, %rcx
	vmovups	%zmm2, 832(%rsp)
	vbroadcastss	(%rcx), %zmm2
	movabsq	$.LCPI0_12, %rcx
	vmovups	%zmm3, 1408(%rsp)
	vbroadcastss	(%rcx), %zmm3
	movabsq	$.LCPI0_42, %rcx
	vmovups	%zmm2, 1472(%rsp)
	vbroadcastss	(%rcx), %zmm2
	movabsq	$.LCPI0_44, %rcx
	vmovups	%zmm3, 1536(%rsp)
	vpbroadcastd	(%rcx), %zmm3
	vmovups	%zmm2, 3584(%rsp)
	vbroadcastsd	(%r15), %zmm2
	movabsq	$.LCPI0_37, %rcx
	vmovups	%zmm2, 3072(%rsp)
	vmovdqu64	%zmm3, 1664(%rsp)
	jmp	.LBB0_4
	.p2align	4
.LBB0_32:
	movq	568(%rsp), %r8
	incq	%r8
	cmpq	40(%rsp), %r8
	je	.LBB0_33
.LBB0_4:
	vmovss	56(%rsp), %xmm1
	movq	%r8, %r15
	leal	1(%r8,%r8), %r8d
	vmovups	3520(%rsp), %zmm3
	movq	%r15, 568(%rsp)
	vcvtsi2ss	%r8d, %xmm15, %xmm0
	movq	24(%rsp), %r8
	imull	%r15d, %r8d
	movq	%r8, 48(%rsp)
	movq	32(%rsp), %r8
	vsubss	%xmm0, %xmm1, %xmm0
	movq	%r8, 240(%rsp)
	vdivss	%xmm1, %xmm0, %xmm0
	vmovss	%xmm0, 528(%rsp)
	jmp	.LBB0_5
	.p2align	4
.LBB0_31:
	vcmpgtps	1664(%rsp), %zmm5, %k1
	vmovdqa32	%zmm13, %zmm3 {%k3}
	vpslld	$2, %zmm3, %zmm0
	vmovups	2048(%rsp), %zmm3
	vmovups	576(%rsp), %zmm4
	vpmovm2d	%k2, %zmm1
	vpsrld	$31, %zmm1, %zmm1
	movq	48(%rsp), %r8
	movq	240(%rsp), %r15
	movq	224(%rsp), %rbx
	vpord	%zmm1, %zmm0, %zmm0 {%k7} {z}
	addl	%r15d, %r8d
	addq	$16, %r15
	movslq	%r8d, %r8
	movq	%r15, 240(%rsp)
	vmovaps	%zmm11, %zmm2 {%k1}
	vmovaps	%zmm2, %zmm3 {%k2}
	vmovaps	%zmm3, %zmm4 {%k7}
	vaddps	2944(%rsp), %zmm4, %zmm1
	vmovdqu64	3008(%rsp), %zmm3
	vpaddd	2560(%rsp), %zmm3, %zmm3
	vmovups	%zmm1, (%rbx,%r8,4)
	movq	216(%rsp), %rbx
	vmovdqu64	%zmm0, (%rbx,%r8,4)
	movabsq	$EVEN_HI, %rbx
	cmpq	200(%rsp), %r15
	je	.LBB0_32
.LBB0_5:
	vmovups	%zmm3, 3008(%rsp)
	vorps	3904(%rsp), %zmm3, %zmm3
	vmovups	2624(%rsp), %zmm4
	movq	232(%rsp), %r8
	vmovss	528(%rsp), %xmm7
	vmovups	3840(%rsp), %zmm10
	vmovups	2112(%rsp), %zmm11
	kxorw	%k0, %k0, %k2
	kxorw	%k0, %k0, %k0
	kmovw	%k0, 704(%rsp)
	vmulss	36(%r8), %xmm7, %xmm6
	vbroadcastss	(%r8), %zmm2
	vbroadcastss	4(%r8), %zmm1
	vbroadcastss	8(%r8), %zmm0
	vcvtdq2ps	%zmm3, %zmm3
	vsubps	%zmm4, %zmm3, %zmm3
	vdivps	%zmm4, %zmm3, %zmm3
	vbroadcastss	%xmm6, %zmm6
	vmulps	24(%r8){1to16}, %zmm3, %zmm4
	vmulps	28(%r8){1to16}, %zmm3, %zmm5
	vmulps	32(%r8){1to16}, %zmm3, %zmm3
	vaddps	12(%r8){1to16}, %zmm4, %zmm4
	vaddps	16(%r8){1to16}, %zmm5, %zmm5
	vaddps	20(%r8){1to16}, %zmm3, %zmm3
	vaddps	%zmm6, %zmm4, %zmm4
	vmulss	40(%r8), %xmm7, %xmm6
	vmulps	%zmm4, %zmm4, %zmm8
	vbroadcastss	%xmm6, %zmm6
	vaddps	%zmm6, %zmm5, %zmm5
	vmulss	44(%r8), %xmm7, %xmm6
	vmulps	%zmm5, %zmm5, %zmm7
	vbroadcastss	%xmm6, %zmm6
	vaddps	%zmm6, %zmm3, %zmm3
	vaddps	%zmm7, %zmm8, %zmm6
	vmulps	%zmm3, %zmm3, %zmm8
	vaddps	%zmm6, %zmm8, %zmm6
	vsqrtps	%zmm6, %zmm6
	vdivps	%zmm6, %zmm10, %zmm6
	vmulps	%zmm6, %zmm5, %zmm14
	vmulps	%zmm6, %zmm4, %zmm13
	vmulps	%zmm6, %zmm3, %zmm15
	vxorps	%xmm5, %xmm5, %xmm5
	vsubss	%xmm2, %xmm5, %xmm3
	vsubss	%xmm1, %xmm5, %xmm4
	vsubss	%xmm0, %xmm5, %xmm5
	vbroadcastss	%xmm3, %zmm3
	vbroadcastss	%xmm4, %zmm4
	vbroadcastss	%xmm5, %zmm5
	vmulps	%zmm11, %zmm13, %zmm6
	vmovups	%zmm13, 1344(%rsp)
	vmovups	%zmm14, 1984(%rsp)
	vmovups	%zmm15, 1920(%rsp)
	vmulps	%zmm13, %zmm3, %zmm3
	vmulps	%zmm14, %zmm4, %zmm4
	vmulps	%zmm15, %zmm5, %zmm5
	vsubps	%zmm13, %zmm6, %zmm7
	vaddps	%zmm4, %zmm3, %zmm3
	vsubps	%zmm7, %zmm6, %zmm6
	vaddps	%zmm3, %zmm5, %zmm12
	vsubps	%zmm6, %zmm13, %zmm7
	vmulps	%zmm11, %zmm12, %zmm4
	vmulps	%zmm12, %zmm13, %zmm3
	vmovups	%zmm12, 2944(%rsp)
	vsubps	%zmm12, %zmm4, %zmm5
	vaddps	%zmm3, %zmm2, %zmm17
	vsubps	%zmm5, %zmm4, %zmm4
	vmulps	%zmm4, %zmm6, %zmm8
	vsubps	%zmm4, %zmm12, %zmm5
	vmulps	%zmm4, %zmm7, %zmm9
	vsubps	%zmm8, %zmm3, %zmm8
	vmulps	%zmm5, %zmm6, %zmm6
	vmulps	%zmm5, %zmm7, %zmm7
	vsubps	%zmm9, %zmm8, %zmm8
	vsubps	%zmm6, %zmm8, %zmm6
	vsubps	%zmm2, %zmm17, %zmm8
	vsubps	%zmm8, %zmm17, %zmm9
	vsubps	%zmm8, %zmm3, %zmm3
	vsubps	%zmm6, %zmm7, %zmm6
	vsubps	%zmm9, %zmm2, %zmm2
	vaddps	%zmm2, %zmm3, %zmm2
	vmulps	%zmm11, %zmm14, %zmm3
	vsubps	%zmm14, %zmm3, %zmm7
	vaddps	%zmm6, %zmm2, %zmm2
	vsubps	%zmm7, %zmm3, %zmm3
	vaddps	%zmm2, %zmm17, %zmm9
	vmulps	%zmm12, %zmm14, %zmm2
	vmulps	%zmm4, %zmm3, %zmm7
	vsubps	%zmm3, %zmm14, %zmm6
	vmulps	%zmm5, %zmm3, %zmm3
	vaddps	%zmm2, %zmm1, %zmm17
	vmovups	%zmm9, 1856(%rsp)
	vmulps	%zmm4, %zmm6, %zmm8
	vsubps	%zmm7, %zmm2, %zmm7
	vmulps	%zmm5, %zmm6, %zmm6
	vsubps	%zmm8, %zmm7, %zmm7
	vsubps	%zmm3, %zmm7, %zmm3
	vsubps	%zmm1, %zmm17, %zmm7
	vsubps	%zmm7, %zmm17, %zmm8
	vsubps	%zmm7, %zmm2, %zmm2
	vsubps	%zmm3, %zmm6, %zmm3
	vsubps	%zmm8, %zmm1, %zmm1
	vaddps	%zmm1, %zmm2, %zmm1
	vmulps	%zmm11, %zmm15, %zmm2
	vsubps	%zmm15, %zmm2, %zmm8
	vaddps	%zmm3, %zmm1, %zmm1
	vsubps	%zmm8, %zmm2, %zmm2
	vaddps	%zmm1, %zmm17, %zmm7
	vmulps	%zmm12, %zmm15, %zmm1
	vmulps	%zmm4, %zmm2, %zmm6
	vsubps	%zmm2, %zmm15, %zmm3
	vmulps	%zmm5, %zmm2, %zmm2
	vmovups	%zmm7, 2240(%rsp)
	vmulps	%zmm4, %zmm3, %zmm4
	vsubps	%zmm6, %zmm1, %zmm6
	vmulps	%zmm5, %zmm3, %zmm3
	vsubps	%zmm4, %zmm6, %zmm4
	vaddps	%zmm1, %zmm0, %zmm6
	vsubps	%zmm2, %zmm4, %zmm2
	vsubps	%zmm0, %zmm6, %zmm4
	vsubps	%zmm4, %zmm6, %zmm5
	vsubps	%zmm4, %zmm1, %zmm1
	vsubps	%zmm2, %zmm3, %zmm2
	vmulps	%zmm9, %zmm13, %zmm3
	vsubps	%zmm5, %zmm0, %zmm0
	vaddps	%zmm0, %zmm1, %zmm0
	vmulps	%zmm14, %zmm14, %zmm1
	vaddps	%zmm2, %zmm0, %zmm0
	vmulps	%zmm13, %zmm13, %zmm2
	vaddps	%zmm0, %zmm6, %zmm5
	vaddps	%zmm1, %zmm2, %zmm0
	vmulps	%zmm15, %zmm15, %zmm2
	vaddps	%zmm0, %zmm2, %zmm0
	vmulps	%zmm7, %zmm14, %zmm2
	vmovups	%zmm5, 1792(%rsp)
	vaddps	%zmm2, %zmm3, %zmm1
	vmulps	%zmm5, %zmm15, %zmm3
	vaddps	%zmm1, %zmm3, %zmm1
	vxorps	1472(%rsp), %zmm1, %zmm1
	vdivps	%zmm0, %zmm1, %zmm1
	vmulps	%zmm1, %zmm13, %zmm2
	vmulps	%zmm1, %zmm14, %zmm3
	vmulps	%zmm1, %zmm15, %zmm4
	vaddps	%zmm2, %zmm9, %zmm2
	vaddps	%zmm3, %zmm7, %zmm3
	vaddps	%zmm4, %zmm5, %zmm4
	vmulps	%zmm2, %zmm2, %zmm2
	vmulps	%zmm3, %zmm3, %zmm3
	vmulps	%zmm4, %zmm4, %zmm4
	vaddps	%zmm3, %zmm2, %zmm2
	vmovups	3776(%rsp), %zmm3
	vaddps	%zmm2, %zmm4, %zmm2
	vmovups	3648(%rsp), %zmm4
	vsubps	%zmm2, %zmm3, %zmm2
	vxorps	%xmm3, %xmm3, %xmm3
	vsubps	%zmm12, %zmm3, %zmm5
	vdivps	%zmm0, %zmm2, %zmm0
	vcmpnltps	%zmm3, %zmm2, %k1
	vmovaps	%zmm10, %zmm2
	vsqrtps	%zmm0, %zmm0
	vmulps	3712(%rsp), %zmm0, %zmm0
	vsubps	%zmm0, %zmm1, %zmm2 {%k1}
	vaddps	%zmm0, %zmm1, %zmm0 {%k1} {z}
	vsubps	%zmm12, %zmm4, %zmm1
	kxorw	%k0, %k0, %k1
	vminps	%zmm1, %zmm0, %zmm0
	vmaxps	%zmm5, %zmm2, %zmm2
	vxorps	%xmm1, %xmm1, %xmm1
	vcmpleps	%zmm0, %zmm2, %k7
	vmovups	%zmm2, 576(%rsp)
	vmovups	%zmm0, 2048(%rsp)
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1728(%rsp)
	vmovups	%zmm0, 896(%rsp)
	vmovups	%zmm0, 960(%rsp)
	vxorps	%xmm2, %xmm2, %xmm2
	vmovups	%zmm0, 640(%rsp)
	kortestw	%k7, %k7
	je	.LBB0_9
	vmovups	576(%rsp), %zmm1
	vmovups	2048(%rsp), %zmm2
	movabsq	$.LCPI0_13, %r8
	vmovups	1984(%rsp), %zmm17
	vmovups	2240(%rsp), %zmm18
	vmovups	1920(%rsp), %zmm26
	vsubps	%zmm1, %zmm2, %zmm0
	vaddps	%zmm2, %zmm1, %zmm1
	vmulps	%zmm16, %zmm0, %zmm4
	vmulps	(%r8){1to16}, %zmm4, %zmm0
	vmulps	%zmm16, %zmm1, %zmm8
	xorl	%r8d, %r8d
	vmulps	%zmm20, %zmm4, %zmm3
	vmulps	%zmm16, %zmm4, %zmm1
	vsubps	%zmm4, %zmm8, %zmm2
	vaddps	%zmm4, %zmm8, %zmm5
	vmovups	%zmm4, 1728(%rsp)
	vmovups	1344(%rsp), %zmm4
	vmovups	%zmm8, 896(%rsp)
	vsubps	%zmm1, %zmm8, %zmm6
	vaddps	%zmm3, %zmm8, %zmm3
	vaddps	%zmm1, %zmm8, %zmm1
	vmulps	%zmm2, %zmm17, %zmm9
	vmulps	%zmm5, %zmm17, %zmm11
	vmulps	%zmm6, %zmm17, %zmm13
	vmulps	%zmm3, %zmm17, %zmm15
	vmulps	%zmm1, %zmm17, %zmm21
	vaddps	%zmm9, %zmm18, %zmm9
	vaddps	%zmm11, %zmm18, %zmm11
	vsubps	%zmm0, %zmm8, %zmm7
	vaddps	%zmm0, %zmm8, %zmm0
	vmulps	%zmm2, %zmm4, %zmm8
	vmulps	%zmm5, %zmm4, %zmm10
	vmulps	%zmm6, %zmm4, %zmm12
	vmulps	%zmm3, %zmm4, %zmm14
	vmulps	%zmm1, %zmm4, %zmm19
	vmulps	%zmm2, %zmm26, %zmm2
	vmulps	%zmm5, %zmm26, %zmm5
	vmulps	%zmm6, %zmm26, %zmm6
	vmulps	%zmm3, %zmm26, %zmm3
	vmulps	%zmm1, %zmm26, %zmm1
	vaddps	%zmm13, %zmm18, %zmm13
	vaddps	%zmm15, %zmm18, %zmm15
	vaddps	%zmm21, %zmm18, %zmm21
	vmulps	%zmm9, %zmm9, %zmm9
	vmulps	%zmm11, %zmm11, %zmm11
	vmulps	%zmm7, %zmm17, %zmm28
	vmulps	%zmm0, %zmm17, %zmm30
	vmovups	1856(%rsp), %zmm17
	vmulps	%zmm7, %zmm4, %zmm22
	vmulps	%zmm0, %zmm4, %zmm29
	vmovups	1600(%rsp), %zmm4
	vmulps	%zmm0, %zmm26, %zmm0
	vmulps	%zmm7, %zmm26, %zmm7
	vmulps	%zmm13, %zmm13, %zmm13
	vmulps	%zmm15, %zmm15, %zmm15
	vaddps	%zmm28, %zmm18, %zmm28
	vaddps	%zmm30, %zmm18, %zmm30
	vmovups	1792(%rsp), %zmm18
	vaddps	%zmm8, %zmm17, %zmm8
	vaddps	%zmm22, %zmm17, %zmm22
	vaddps	%zmm29, %zmm17, %zmm29
	vaddps	%zmm19, %zmm17, %zmm19
	vaddps	%zmm12, %zmm17, %zmm12
	vaddps	%zmm10, %zmm17, %zmm10
	vaddps	%zmm14, %zmm17, %zmm14
	vmulps	%zmm4, %zmm13, %zmm17
	vaddps	%zmm2, %zmm18, %zmm31
	vaddps	%zmm0, %zmm18, %zmm0
	vmulps	%zmm8, %zmm8, %zmm8
	vaddps	%zmm5, %zmm18, %zmm5
	vaddps	%zmm6, %zmm18, %zmm6
	vaddps	%zmm3, %zmm18, %zmm3
	vaddps	%zmm7, %zmm18, %zmm2
	vaddps	%zmm1, %zmm18, %zmm1
	vmulps	%zmm29, %zmm29, %zmm18
	vmulps	%zmm19, %zmm19, %zmm26
	vmulps	%zmm21, %zmm21, %zmm19
	vmulps	%zmm12, %zmm12, %zmm12
	vmulps	%zmm10, %zmm10, %zmm10
	vmovups	%zmm17, 1152(%rsp)
	vmulps	%zmm14, %zmm14, %zmm14
	vmovups	%zmm0, 704(%rsp)
	vmulps	%zmm22, %zmm22, %zmm0
	vmulps	%zmm28, %zmm28, %zmm22
	vmulps	%zmm30, %zmm30, %zmm28
	vmulps	%zmm31, %zmm31, %zmm29
	vmulps	%zmm4, %zmm8, %zmm30
	vmulps	%zmm4, %zmm9, %zmm31
	vaddps	%zmm9, %zmm8, %zmm21
	vmovups	%zmm2, 320(%rsp)
	vmulps	%zmm4, %zmm12, %zmm2
	vmulps	%zmm1, %zmm1, %zmm7
	vmulps	%zmm4, %zmm10, %zmm1
	vmulps	%zmm5, %zmm5, %zmm5
	vmulps	%zmm6, %zmm6, %zmm6
	vaddps	%zmm13, %zmm12, %zmm17
	vmulps	%zmm3, %zmm3, %zmm3
	vsubps	%zmm9, %zmm30, %zmm9
	vmulps	%zmm4, %zmm29, %zmm30
	vmovups	%zmm0, 1088(%rsp)
	vmulps	%zmm4, %zmm11, %zmm0
	vsubps	%zmm11, %zmm1, %zmm1
	vsubps	%zmm29, %zmm31, %zmm31
	vsubps	%zmm8, %zmm30, %zmm8
	vmovups	%zmm0, 256(%rsp)
	vaddps	%zmm11, %zmm10, %zmm0
	vmovups	%zmm1, 768(%rsp)
	vmulps	%zmm4, %zmm5, %zmm11
	vmulps	%zmm4, %zmm14, %zmm30
	vmovups	%zmm8, 64(%rsp)
	vaddps	%zmm21, %zmm29, %zmm8
	vsubps	%zmm13, %zmm2, %zmm21
	vmovups	704(%rsp), %zmm2
	vaddps	%zmm0, %zmm5, %zmm0
	vmulps	%zmm4, %zmm6, %zmm13
	vsubps	%zmm10, %zmm11, %zmm10
	vmulps	%zmm4, %zmm15, %zmm29
	vaddps	%zmm15, %zmm14, %zmm11
	vsubps	%zmm15, %zmm30, %zmm15
	vmulps	%zmm4, %zmm3, %zmm30
	vmovups	%zmm8, 640(%rsp)
	vmovups	256(%rsp), %zmm8
	vmovups	%zmm0, 1216(%rsp)
	vmulps	%zmm31, %zmm9, %zmm0
	vmulps	%zmm4, %zmm19, %zmm31
	vmovups	%zmm10, 448(%rsp)
	vsubps	%zmm14, %zmm30, %zmm14
	vmulps	%zmm4, %zmm22, %zmm30
	vsubps	%zmm3, %zmm29, %zmm29
	vmovups	%zmm0, 256(%rsp)
	vsubps	%zmm12, %zmm13, %zmm0
	vaddps	%zmm17, %zmm6, %zmm12
	vmovups	1088(%rsp), %zmm17
	vaddps	%zmm19, %zmm26, %zmm13
	vsubps	%zmm7, %zmm31, %zmm31
	vmulps	%zmm29, %zmm15, %zmm15
	vmovups	%zmm0, 384(%rsp)
	vmovups	320(%rsp), %zmm0
	vaddps	%zmm13, %zmm7, %zmm13
	vmulps	%zmm4, %zmm7, %zmm7
	vmulps	%zmm15, %zmm14, %zmm14
	vsubps	%zmm5, %zmm8, %zmm1
	vmulps	%zmm4, %zmm26, %zmm5
	vaddps	%zmm11, %zmm3, %zmm8
	vsubps	%zmm26, %zmm7, %zmm7
	vmovups	%zmm1, 1280(%rsp)
	vmulps	%zmm2, %zmm2, %zmm1
	vmovups	1152(%rsp), %zmm2
	vaddps	%zmm22, %zmm17, %zmm11
	vmulps	%zmm0, %zmm0, %zmm0
	vsubps	%zmm0, %zmm30, %zmm30
	vaddps	%zmm11, %zmm0, %zmm11
	vmulps	%zmm4, %zmm0, %zmm0
	vsubps	%zmm6, %zmm2, %zmm10
	vsubps	%zmm19, %zmm5, %zmm6
	vmulps	%zmm4, %zmm18, %zmm19
	vmulps	%zmm4, %zmm17, %zmm2
	vsubps	%zmm17, %zmm0, %zmm0
	vmovups	256(%rsp), %zmm17
	vsubps	%zmm22, %zmm2, %zmm9
	vmulps	%zmm4, %zmm28, %zmm22
	vsubps	%zmm28, %zmm19, %zmm19
	vaddps	%zmm28, %zmm18, %zmm28
	vmovups	1280(%rsp), %zmm2
	vmulps	%zmm10, %zmm21, %zmm10
	vmulps	384(%rsp), %zmm10, %zmm10
	vmulps	%zmm31, %zmm6, %zmm6
	vmulps	768(%rsp), %zmm2, %zmm2
	vsubps	%zmm1, %zmm22, %zmm22
	vaddps	%zmm28, %zmm1, %zmm28
	vmulps	%zmm4, %zmm1, %zmm1
	vmovups	1408(%rsp), %zmm4
	vmulps	%zmm30, %zmm9, %zmm9
	vmulps	%zmm6, %zmm7, %zmm6
	vaddps	640(%rsp), %zmm4, %zmm5
	vaddps	1216(%rsp), %zmm4, %zmm3
	vmulps	448(%rsp), %zmm2, %zmm2
	vmulps	%zmm22, %zmm19, %zmm19
	vmulps	64(%rsp), %zmm17, %zmm22
	vmovups	1536(%rsp), %zmm17
	vsubps	%zmm18, %zmm1, %zmm1
	vmulps	%zmm9, %zmm0, %zmm0
	vmulps	%zmm19, %zmm1, %zmm1
	vaddps	%zmm4, %zmm12, %zmm12
	vaddps	%zmm4, %zmm8, %zmm8
	vaddps	%zmm4, %zmm13, %zmm13
	vaddps	%zmm4, %zmm11, %zmm11
	vaddps	%zmm4, %zmm28, %zmm21
	vmovups	832(%rsp), %zmm4
	vmulps	%zmm5, %zmm5, %zmm5
	vmulps	%zmm3, %zmm3, %zmm3
	vmulps	%zmm13, %zmm13, %zmm7
	vmulps	%zmm12, %zmm12, %zmm12
	vmulps	%zmm11, %zmm11, %zmm9
	vmulps	%zmm8, %zmm8, %zmm8
	vmulps	%zmm21, %zmm21, %zmm11
	vmulps	%zmm17, %zmm5, %zmm5
	vmulps	%zmm17, %zmm3, %zmm3
	vmulps	%zmm17, %zmm12, %zmm12
	vmulps	%zmm17, %zmm7, %zmm7
	vmulps	%zmm17, %zmm9, %zmm9
	vmulps	%zmm17, %zmm8, %zmm8
	vmulps	%zmm17, %zmm11, %zmm11
	vmulps	%zmm4, %zmm22, %zmm13
	vmulps	%zmm4, %zmm2, %zmm2
	vmulps	%zmm4, %zmm0, %zmm15
	vmulps	%zmm4, %zmm10, %zmm10
	vmulps	%zmm4, %zmm6, %zmm6
	vmulps	%zmm4, %zmm14, %zmm14
	vmulps	%zmm4, %zmm1, %zmm1
	vmovups	1472(%rsp), %zmm4
	vsubps	%zmm3, %zmm2, %zmm0
	vsubps	%zmm5, %zmm13, %zmm13
	vmovups	2112(%rsp), %zmm3
	vsubps	%zmm12, %zmm10, %zmm30
	vsubps	%zmm7, %zmm6, %zmm31
	vsubps	%zmm9, %zmm15, %zmm21
	vsubps	%zmm8, %zmm14, %zmm2
	vsubps	%zmm11, %zmm1, %zmm8
	vsubps	%zmm13, %zmm0, %zmm28
	vaddps	%zmm0, %zmm13, %zmm18
	vsubps	%zmm30, %zmm31, %zmm22
	vaddps	%zmm30, %zmm31, %zmm17
	vmovups	%zmm2, 2176(%rsp)
	vaddps	%zmm21, %zmm8, %zmm14
	vmovups	%zmm13, 960(%rsp)
	vsubps	%zmm21, %zmm8, %zmm7
	vmovups	%zmm30, 2880(%rsp)
	vmovups	%zmm8, 2688(%rsp)
	vmovups	%zmm21, 2752(%rsp)
	vmovups	%zmm31, 2816(%rsp)
	vxorps	%zmm4, %zmm13, %zmm1
	vxorps	%zmm4, %zmm30, %zmm29
	vsubps	%zmm0, %zmm28, %zmm6
	vsubps	%zmm0, %zmm18, %zmm2
	vsubps	%zmm31, %zmm22, %zmm19
	vsubps	%zmm31, %zmm17, %zmm12
	vmovups	%zmm28, 704(%rsp)
	vmovups	%zmm18, 1216(%rsp)
	vmovups	%zmm14, 448(%rsp)
	vmovups	%zmm7, 3392(%rsp)
	vmovups	%zmm17, 768(%rsp)
	vmovups	%zmm22, 3456(%rsp)
	vmulps	%zmm3, %zmm18, %zmm5
	vmulps	%zmm3, %zmm28, %zmm10
	vmulps	%zmm3, %zmm17, %zmm15
	vsubps	%zmm6, %zmm28, %zmm11
	vsubps	%zmm6, %zmm1, %zmm26
	vxorps	%zmm4, %zmm21, %zmm1
	vsubps	%zmm2, %zmm18, %zmm9
	vsubps	%zmm2, %zmm13, %zmm2
	vsubps	%zmm19, %zmm29, %zmm4
	vsubps	%zmm8, %zmm7, %zmm29
	vmovups	%zmm1, 64(%rsp)
	vsubps	%zmm18, %zmm5, %zmm13
	vsubps	%zmm28, %zmm10, %zmm6
	vsubps	%zmm11, %zmm0, %zmm1
	vsubps	%zmm19, %zmm22, %zmm11
	vsubps	%zmm9, %zmm0, %zmm9
	vmulps	%zmm3, %zmm14, %zmm19
	vsubps	%zmm6, %zmm10, %zmm0
	vsubps	%zmm13, %zmm5, %zmm13
	vsubps	%zmm12, %zmm30, %zmm6
	vsubps	%zmm12, %zmm17, %zmm5
	vsubps	%zmm8, %zmm14, %zmm12
	vsubps	%zmm17, %zmm15, %zmm10
	vmulps	%zmm3, %zmm7, %zmm30
	vaddps	%zmm1, %zmm26, %zmm1
	vaddps	%zmm9, %zmm2, %zmm2
	vmovups	%zmm0, 3328(%rsp)
	vsubps	%zmm0, %zmm28, %zmm28
	vsubps	%zmm5, %zmm31, %zmm0
	vsubps	%zmm12, %zmm14, %zmm5
	vsubps	%zmm13, %zmm18, %zmm9
	vmovups	%zmm13, 1088(%rsp)
	vsubps	%zmm10, %zmm15, %zmm13
	vsubps	%zmm12, %zmm21, %zmm10
	vsubps	%zmm29, %zmm7, %zmm12
	vmovups	%zmm1, 3264(%rsp)
	vsubps	%zmm11, %zmm31, %zmm1
	vmovups	64(%rsp), %zmm11
	vmovups	%zmm2, 2496(%rsp)
	vaddps	%zmm0, %zmm6, %zmm0
	vmovups	2176(%rsp), %zmm6
	vmovups	%zmm9, 2304(%rsp)
	vsubps	%zmm14, %zmm19, %zmm9
	vmovups	%zmm13, 320(%rsp)
	vaddps	%zmm1, %zmm4, %zmm1
	vmovups	%zmm0, 384(%rsp)
	vsubps	%zmm7, %zmm30, %zmm0
	vsubps	%zmm9, %zmm19, %zmm4
	vmovups	%zmm1, 3200(%rsp)
	vsubps	%zmm5, %zmm8, %zmm1
	vsubps	%zmm12, %zmm8, %zmm5
	vsubps	%zmm29, %zmm11, %zmm11
	vsubps	%zmm0, %zmm30, %zmm29
	vmovups	%zmm4, 2368(%rsp)
	vaddps	%zmm1, %zmm10, %zmm2
	vaddps	%zmm5, %zmm11, %zmm1
	vsubps	%zmm29, %zmm7, %zmm10
	vmovups	%zmm2, 1152(%rsp)
	vmulps	%zmm3, %zmm22, %zmm2
	vmovups	%zmm1, 3136(%rsp)
	vsubps	%zmm22, %zmm2, %zmm1
	vsubps	%zmm1, %zmm2, %zmm5
	vaddps	%zmm20, %zmm6, %zmm2
	vsubps	%zmm6, %zmm2, %zmm8
	vmulps	%zmm3, %zmm2, %zmm3
	vsubps	%zmm5, %zmm22, %zmm21
	vmovups	%zmm2, 64(%rsp)
	vsubps	%zmm8, %zmm2, %zmm1
	vsubps	%zmm8, %zmm20, %zmm0
	vsubps	%zmm1, %zmm6, %zmm1
	vaddps	%zmm1, %zmm0, %zmm0
	vsubps	%zmm2, %zmm3, %zmm1
	vmovups	%zmm0, 256(%rsp)
	vsubps	%zmm1, %zmm3, %zmm0
	vsubps	%zmm4, %zmm14, %zmm3
	vmovss	60(%rsp), %xmm4
	vsubps	%zmm13, %zmm17, %zmm1
	vmovups	%zmm0, 640(%rsp)
	vsubps	%zmm0, %zmm2, %zmm0
	vmovups	%zmm3, 1024(%rsp)
	vmovups	%zmm1, 2432(%rsp)
	vmovups	%zmm0, 1280(%rsp)
	.p2align	4
.LBB0_7:
	movq	%r8, %r15
	shlq	$4, %r15
	vmovups	1216(%rsp), %zmm0
	vmovups	1088(%rsp), %zmm2
	vmovups	2304(%rsp), %zmm3
	vmovups	448(%rsp), %zmm13
	vmovups	768(%rsp), %zmm17
	movabsq	$ODD_LO, %r12
	vbroadcastss	(%rbx,%r15), %zmm6
	vbroadcastss	4(%rbx,%r15), %zmm8
	vmulss	%xmm4, %xmm6, %xmm1
	vmulps	%zmm6, %zmm0, %zmm19
	vmulps	(%rsi,%r15){1to16}, %zmm0, %zmm0
	vsubss	%xmm6, %xmm1, %xmm12
	vaddps	%zmm20, %zmm19, %zmm11
	vsubss	%xmm12, %xmm1, %xmm1
	vsubps	%zmm11, %zmm11, %zmm7
	vsubps	%zmm11, %zmm19, %zmm15
	vbroadcastss	%xmm1, %zmm12
	vsubss	%xmm1, %xmm6, %xmm1
	vmulps	2496(%rsp), %zmm6, %zmm6
	vmulps	%zmm12, %zmm2, %zmm30
	vmulps	%zmm12, %zmm3, %zmm31
	vbroadcastss	%xmm1, %zmm12
	vaddps	%zmm7, %zmm15, %zmm1
	vmulps	%zmm12, %zmm2, %zmm22
	vsubps	%zmm30, %zmm19, %zmm19
	vmulps	%zmm8, %zmm13, %zmm30
	vsubps	%zmm31, %zmm19, %zmm18
	vbroadcastss	8(%rbx,%r15), %zmm31
	vaddps	%zmm0, %zmm6, %zmm15
	vmulps	%zmm12, %zmm3, %zmm6
	vmulss	%xmm4, %xmm8, %xmm12
	vmovups	2368(%rsp), %zmm0
	vmovups	1024(%rsp), %zmm3
	vsubss	%xmm8, %xmm12, %xmm14
	vsubss	%xmm14, %xmm12, %xmm12
	vbroadcastss	%xmm12, %zmm14
	vsubss	%xmm12, %xmm8, %xmm12
	vmulps	1152(%rsp), %zmm8, %zmm8
	vmulps	%zmm14, %zmm0, %zmm9
	vmulps	%zmm14, %zmm3, %zmm14
	vbroadcastss	%xmm12, %zmm12
	vsubps	%zmm9, %zmm30, %zmm9
	vmulps	%zmm12, %zmm0, %zmm2
	vaddps	%zmm30, %zmm11, %zmm0
	vmulps	%zmm12, %zmm3, %zmm12
	vsubps	%zmm14, %zmm9, %zmm9
	vmulps	4(%rsi,%r15){1to16}, %zmm13, %zmm14
	vsubps	%zmm11, %zmm0, %zmm3
	vmovups	320(%rsp), %zmm13
	vsubps	%zmm0, %zmm3, %zmm7
	vsubps	%zmm3, %zmm30, %zmm3
	vsubps	%zmm2, %zmm9, %zmm2
	vaddps	%zmm7, %zmm11, %zmm7
	vsubps	%zmm22, %zmm18, %zmm11
	vmovups	2432(%rsp), %zmm18
	vsubps	%zmm2, %zmm12, %zmm2
	vaddps	%zmm7, %zmm3, %zmm19
	vsubps	%zmm11, %zmm6, %zmm11
	vaddps	%zmm14, %zmm8, %zmm30
	vmulss	%xmm4, %xmm31, %xmm8
	vaddps	%zmm11, %zmm15, %zmm11
	vsubss	%xmm31, %xmm8, %xmm14
	vaddps	%zmm2, %zmm30, %zmm2
	vaddps	%zmm11, %zmm1, %zmm1
	vsubss	%xmm14, %xmm8, %xmm8
	vaddps	%zmm2, %zmm19, %zmm2
	vbroadcastss	%xmm8, %zmm3
	vsubss	%xmm8, %xmm31, %xmm7
	vmulps	%zmm31, %zmm17, %zmm8
	vaddps	%zmm2, %zmm1, %zmm1
	vmulps	%zmm3, %zmm13, %zmm14
	vmulps	%zmm3, %zmm18, %zmm3
	vbroadcastss	%xmm7, %zmm7
	vaddps	%zmm8, %zmm0, %zmm9
	vsubps	%zmm14, %zmm8, %zmm14
	vmulps	%zmm7, %zmm13, %zmm22
	vmulps	%zmm7, %zmm18, %zmm7
	vmulps	384(%rsp), %zmm31, %zmm18
	vsubps	%zmm0, %zmm9, %zmm26
	vsubps	%zmm3, %zmm14, %zmm3
	vmulps	8(%rsi,%r15){1to16}, %zmm17, %zmm14
	vmovups	640(%rsp), %zmm17
	vsubps	%zmm9, %zmm26, %zmm13
	vsubps	%zmm26, %zmm8, %zmm8
	vmovups	64(%rsp), %zmm26
	vsubps	%zmm22, %zmm3, %zmm3
	vbroadcastss	12(%rbx,%r15), %zmm22
	leaq	(,%r8,4), %rbx
	vaddps	%zmm13, %zmm0, %zmm0
	leaq	(%rbx,%rbx,2), %rbx
	vsubps	%zmm3, %zmm7, %zmm3
	vaddps	%zmm0, %zmm8, %zmm31
	vaddps	%zmm14, %zmm18, %zmm0
	vmovups	1280(%rsp), %zmm18
	vmulss	%xmm4, %xmm22, %xmm8
	vaddps	%zmm3, %zmm0, %zmm0
	vsubss	%xmm22, %xmm8, %xmm14
	vaddps	%zmm0, %zmm31, %zmm0
	vsubss	%xmm14, %xmm8, %xmm8
	vmulps	%zmm22, %zmm26, %zmm14
	vaddps	%zmm0, %zmm1, %zmm0
	vsubss	%xmm8, %xmm22, %xmm6
	vbroadcastss	%xmm8, %zmm13
	vbroadcastss	%xmm6, %zmm8
	vmulps	%zmm13, %zmm17, %zmm6
	vmulps	%zmm13, %zmm18, %zmm13
	vmulps	%zmm8, %zmm17, %zmm12
	vmulps	%zmm8, %zmm18, %zmm8
	vmovups	3328(%rsp), %zmm17
	vsubps	%zmm6, %zmm14, %zmm6
	vsubps	%zmm13, %zmm6, %zmm6
	vsubps	%zmm12, %zmm6, %zmm12
	vaddps	%zmm14, %zmm9, %zmm6
	vsubps	%zmm9, %zmm6, %zmm7
	vsubps	%zmm12, %zmm8, %zmm8
	vsubps	%zmm6, %zmm7, %zmm13
	vsubps	%zmm7, %zmm14, %zmm7
	vaddps	%zmm13, %zmm9, %zmm9
	vaddps	%zmm9, %zmm7, %zmm12
	vmulps	256(%rsp), %zmm22, %zmm7
	vmulps	12(%rsi,%r15){1to16}, %zmm26, %zmm9
	movabsq	$ODD_HI, %r15
	vmovups	704(%rsp), %zmm22
	vbroadcastss	(%r15,%rbx), %zmm13
	vmulps	(%r12,%rbx){1to16}, %zmm22, %zmm11
	vaddps	%zmm9, %zmm7, %zmm7
	vmulss	%xmm4, %xmm13, %xmm9
	vsubss	%xmm13, %xmm9, %xmm14
	vaddps	%zmm8, %zmm7, %zmm7
	vsubss	%xmm14, %xmm9, %xmm9
	vaddps	%zmm7, %zmm12, %zmm7
	vsubss	%xmm9, %xmm13, %xmm3
	vbroadcastss	%xmm9, %zmm14
	vmulps	%zmm13, %zmm22, %zmm9
	vmulps	3264(%rsp), %zmm13, %zmm13
	vaddps	%zmm7, %zmm0, %zmm0
	vmulps	%zmm14, %zmm17, %zmm15
	vmulps	%zmm14, %zmm28, %zmm14
	vbroadcastss	%xmm3, %zmm3
	vaddps	%zmm20, %zmm9, %zmm8
	vaddps	%zmm0, %zmm6, %zmm0
	vsubps	%zmm15, %zmm9, %zmm15
	vsubps	%zmm8, %zmm9, %zmm9
	vsubps	%zmm14, %zmm15, %zmm14
	vmulps	%zmm3, %zmm17, %zmm15
	vmulps	%zmm3, %zmm28, %zmm3
	vmovups	3392(%rsp), %zmm17
	vaddps	%zmm11, %zmm13, %zmm11
	vbroadcastss	4(%r15,%rbx), %zmm13
	vsubps	%zmm15, %zmm14, %zmm14
	vsubps	%zmm14, %zmm3, %zmm3
	vsubps	%zmm8, %zmm8, %zmm14
	vaddps	%zmm3, %zmm11, %zmm3
	vaddps	%zmm14, %zmm9, %zmm9
	vmulss	%xmm4, %xmm13, %xmm11
	vmulps	%zmm13, %zmm17, %zmm15
	vaddps	%zmm3, %zmm9, %zmm3
	vmulps	3136(%rsp), %zmm13, %zmm9
	vsubss	%xmm13, %xmm11, %xmm14
	vaddps	%zmm15, %zmm8, %zmm12
	vsubss	%xmm14, %xmm11, %xmm11
	vbroadcastss	%xmm11, %zmm14
	vsubss	%xmm11, %xmm13, %xmm11
	vmulps	4(%r12,%rbx){1to16}, %zmm17, %zmm13
	vmulps	%zmm14, %zmm29, %zmm19
	vmulps	%zmm14, %zmm10, %zmm14
	vbroadcastss	%xmm11, %zmm11
	vsubps	%zmm19, %zmm15, %zmm19
	vmulps	%zmm11, %zmm29, %zmm18
	vmulps	%zmm11, %zmm10, %zmm11
	vsubps	%zmm14, %zmm19, %zmm14
	vaddps	%zmm13, %zmm9, %zmm9
	vmovups	3456(%rsp), %zmm13
	vsubps	%zmm18, %zmm14, %zmm14
	vsubps	%zmm8, %zmm12, %zmm18
	vsubps	%zmm12, %zmm18, %zmm19
	vsubps	%zmm14, %zmm11, %zmm11
	vsubps	%zmm18, %zmm15, %zmm14
	vaddps	%zmm19, %zmm8, %zmm8
	vaddps	%zmm11, %zmm9, %zmm9
	vaddps	%zmm8, %zmm14, %zmm8
	vaddps	%zmm9, %zmm8, %zmm2
	vbroadcastss	8(%r15,%rbx), %zmm8
	movabsq	$ODD_LO, %r15
	vaddps	%zmm2, %zmm3, %zmm2
	vmulss	%xmm4, %xmm8, %xmm9
	vmulps	%zmm8, %zmm13, %zmm1
	vsubss	%xmm8, %xmm9, %xmm3
	vsubss	%xmm3, %xmm9, %xmm3
	vbroadcastss	%xmm3, %zmm9
	vsubss	%xmm3, %xmm8, %xmm3
	vmulps	3200(%rsp), %zmm8, %zmm8
	vmulps	%zmm9, %zmm5, %zmm11
	vmulps	%zmm9, %zmm21, %zmm9
	vbroadcastss	%xmm3, %zmm3
	vsubps	%zmm11, %zmm1, %zmm11
	vmulps	%zmm3, %zmm5, %zmm14
	vmulps	%zmm3, %zmm21, %zmm3
	vsubps	%zmm9, %zmm11, %zmm9
	vsubps	%zmm14, %zmm9, %zmm9
	vaddps	%zmm1, %zmm12, %zmm14
	vsubps	%zmm12, %zmm14, %zmm11
	vsubps	%zmm9, %zmm3, %zmm3
	vsubps	%zmm14, %zmm11, %zmm7
	vsubps	%zmm11, %zmm1, %zmm1
	vmulps	8(%r15,%rbx){1to16}, %zmm13, %zmm11
	movq	%r8, %rbx
	shlq	$7, %rbx
	incq	%r8
	vmovups	%zmm0, 3968(%rsp,%rbx) {%k7}
	vaddps	%zmm7, %zmm12, %zmm7
	vaddps	%zmm7, %zmm1, %zmm1
	vaddps	%zmm11, %zmm8, %zmm7
	vaddps	%zmm3, %zmm7, %zmm3
	vaddps	%zmm3, %zmm1, %zmm1
	vaddps	%zmm1, %zmm2, %zmm1
	vaddps	%zmm1, %zmm14, %zmm0
	vmovups	%zmm0, 4032(%rsp,%rbx) {%k7}
	movabsq	$EVEN_HI, %rbx
	cmpq	$3, %r8
	jne	.LBB0_7
	vcmpgtps	960(%rsp), %zmm20, %k3
	vcmpngtps	2688(%rsp), %zmm20, %k0
	movabsq	$.LCPI0_13, %r8
	movabsq	$.LCPI0_17, %r15
	vmovups	1088(%rsp), %zmm6
	vmovups	2304(%rsp), %zmm7
	vmovups	1216(%rsp), %zmm4
	movabsq	$.LCPI0_22, %rbx
	vmovups	448(%rsp), %zmm26
	vmovups	1024(%rsp), %zmm11
	movq	208(%rsp), %r12
	vbroadcastss	(%r8), %zmm0
	movabsq	$.LCPI0_2, %r8
	vbroadcastss	(%r15), %zmm3
	kxorw	%k3, %k0, %k1
	vcmpngtps	2816(%rsp), %zmm20, %k0
	kmovw	%k3, 704(%rsp)
	vbroadcastss	(%r8), %zmm0 {%k1}
	movabsq	$.LCPI0_14, %r8
	vmulps	%zmm3, %zmm6, %zmm5
	vmulps	%zmm3, %zmm7, %zmm3
	vbroadcastss	(%r8), %zmm2
	movabsq	$.LCPI0_15, %r8
	vbroadcastss	(%r8), %zmm1
	movabsq	$.LCPI0_16, %r8
	vbroadcastss	(%r8), %zmm8
	movabsq	$.LCPI0_18, %r8
	vmulps	(%r8){1to16}, %zmm6, %zmm6
	movabsq	$.LCPI0_19, %r8
	vmulps	(%r8){1to16}, %zmm7, %zmm7
	movabsq	$.LCPI0_20, %r8
	kxorw	%k3, %k0, %k1
	vcmpngtps	2176(%rsp), %zmm20, %k0
	vblendmps	%zmm0, %zmm16, %zmm0 {%k1}
	kxorw	%k3, %k0, %k1
	vcmpngtps	2880(%rsp), %zmm20, %k0
	vmovaps	%zmm0, %zmm0 {%k1} {z}
	kxorw	%k3, %k0, %k1
	vcmpngtps	2752(%rsp), %zmm20, %k0
	vmovaps	%zmm0, %zmm2 {%k1}
	vmulps	2496(%rsp), %zmm8, %zmm0
	kxorw	%k3, %k0, %k1
	vmovaps	%zmm2, %zmm1 {%k1}
	vmulps	%zmm8, %zmm4, %zmm2
	vmulps	(%r8){1to16}, %zmm4, %zmm4
	movabsq	$.LCPI0_21, %r8
	vbroadcastss	(%r8), %zmm12
	movabsq	$.LCPI0_23, %r8
	vbroadcastss	(%r8), %zmm9
	movabsq	$.LCPI0_24, %r8
	vsubps	%zmm5, %zmm2, %zmm5
	vsubps	%zmm3, %zmm5, %zmm3
	vaddps	%zmm20, %zmm2, %zmm5
	vaddps	%zmm3, %zmm6, %zmm3
	vbroadcastss	(%rbx), %zmm6
	vsubps	%zmm5, %zmm2, %zmm2
	vaddps	%zmm0, %zmm4, %zmm0
	vmovups	2368(%rsp), %zmm4
	vsubps	%zmm3, %zmm7, %zmm3
	vsubps	%zmm5, %zmm5, %zmm7
	vaddps	%zmm7, %zmm2, %zmm2
	vaddps	%zmm3, %zmm0, %zmm0
	vmulps	1152(%rsp), %zmm12, %zmm3
	vaddps	%zmm0, %zmm2, %zmm0
	vmulps	%zmm12, %zmm26, %zmm2
	vmulps	%zmm6, %zmm4, %zmm7
	vmulps	%zmm6, %zmm11, %zmm8
	vmulps	%zmm9, %zmm4, %zmm10
	vmulps	%zmm9, %zmm11, %zmm9
	vmovups	768(%rsp), %zmm12
	vmovups	2432(%rsp), %zmm11
	vaddps	%zmm7, %zmm2, %zmm7
	vaddps	%zmm8, %zmm7, %zmm7
	vaddps	%zmm2, %zmm5, %zmm8
	vsubps	%zmm5, %zmm8, %zmm4
	vsubps	%zmm10, %zmm7, %zmm7
	vsubps	%zmm8, %zmm4, %zmm10
	vsubps	%zmm4, %zmm2, %zmm2
	vmulps	(%r8){1to16}, %zmm26, %zmm4
	movabsq	$.LCPI0_25, %r8
	vsubps	%zmm7, %zmm9, %zmm7
	vmulps	%zmm6, %zmm11, %zmm9
	vbroadcastss	(%r8), %zmm13
	movabsq	$.LCPI0_26, %r8
	vaddps	%zmm10, %zmm5, %zmm5
	vaddps	%zmm5, %zmm2, %zmm2
	vaddps	%zmm4, %zmm3, %zmm3
	vmovups	320(%rsp), %zmm4
	vaddps	%zmm7, %zmm3, %zmm3
	vbroadcastss	(%r8), %zmm7
	movabsq	$.LCPI0_27, %r8
	vmulps	(%r8){1to16}, %zmm11, %zmm11
	movabsq	$.LCPI0_28, %r8
	vaddps	%zmm3, %zmm2, %zmm2
	vmulps	384(%rsp), %zmm13, %zmm3
	vmulps	%zmm6, %zmm4, %zmm5
	vaddps	%zmm2, %zmm0, %zmm0
	vmulps	%zmm13, %zmm12, %zmm2
	vsubps	%zmm5, %zmm2, %zmm5
	vmulps	%zmm7, %zmm4, %zmm10
	vsubps	%zmm9, %zmm5, %zmm5
	vaddps	%zmm8, %zmm2, %zmm9
	vaddps	%zmm5, %zmm10, %zmm5
	vsubps	%zmm8, %zmm9, %zmm10
	vsubps	%zmm9, %zmm10, %zmm4
	vsubps	%zmm10, %zmm2, %zmm2
	vsubps	%zmm5, %zmm11, %zmm5
	vmovups	1280(%rsp), %zmm10
	vaddps	%zmm4, %zmm8, %zmm8
	vmulps	(%r8){1to16}, %zmm12, %zmm4
	movabsq	$.LCPI0_29, %r8
	vbroadcastss	(%r8), %zmm11
	movabsq	$.LCPI0_30, %r8
	vaddps	%zmm8, %zmm2, %zmm2
	vmovups	640(%rsp), %zmm8
	vaddps	%zmm3, %zmm4, %zmm3
	vmovups	64(%rsp), %zmm4
	vaddps	%zmm5, %zmm3, %zmm3
	vmulps	%zmm6, %zmm8, %zmm5
	vmulps	%zmm6, %zmm10, %zmm6
	vmulps	%zmm7, %zmm8, %zmm8
	vmulps	%zmm7, %zmm10, %zmm7
	vaddps	%zmm3, %zmm2, %zmm2
	vmulps	%zmm11, %zmm4, %zmm3
	vmulps	(%r8){1to16}, %zmm4, %zmm4
	leaq	4352(%rsp), %r8
	vaddps	%zmm0, %zmm2, %zmm0
	vmulps	256(%rsp), %zmm11, %zmm2
	vaddps	%zmm5, %zmm3, %zmm5
	vaddps	%zmm6, %zmm5, %zmm5
	vaddps	%zmm9, %zmm3, %zmm6
	vsubps	%zmm9, %zmm6, %zmm10
	vsubps	%zmm8, %zmm5, %zmm5
	vaddps	%zmm4, %zmm2, %zmm2
	vsubps	%zmm6, %zmm10, %zmm8
	vsubps	%zmm5, %zmm7, %zmm5
	vsubps	%zmm10, %zmm3, %zmm3
	vaddps	%zmm8, %zmm9, %zmm8
	vaddps	%zmm5, %zmm2, %zmm2
	vaddps	%zmm8, %zmm3, %zmm3
	vaddps	%zmm2, %zmm3, %zmm2
	vxorps	%xmm3, %xmm3, %xmm3
	vaddps	%zmm0, %zmm2, %zmm0
	vaddps	%zmm0, %zmm6, %zmm2
	vmovups	%zmm2, (%r8) {%k7}
	movabsq	$.LCPI0_31, %r8
	vmovups	4288(%rsp), %zmm0
	vmovups	%zmm0, 640(%rsp)
	vmulps	(%r8){1to16}, %zmm2, %zmm0
	vcmpneqps	%zmm20, %zmm0, %k1
.LBB0_9:
	kmovd	%k7, %r8d
	vmovups	%zmm2, 768(%rsp)
	vxorps	%xmm2, %xmm2, %xmm2
	vxorps	%xmm30, %xmm30, %xmm30
	vxorps	%xmm21, %xmm21, %xmm21
	testw	%r8w, %r8w
	je	.LBB0_26
	vmovups	640(%rsp), %zmm3
	kandw	%k1, %k7, %k1
	movabsq	$.LCPI0_11, %r8
	kmovw	%k7, 544(%rsp)
	vxorps	1472(%rsp), %zmm3, %zmm3
	vpbroadcastd	(%r8), %zmm2 {%k1} {z}
	leaq	6784(%rsp), %r8
	vdivps	%zmm0, %zmm3, %zmm0
	vmovdqa32	%zmm0, %zmm0 {%k1} {z}
	vcmpltps	%zmm0, %zmm2, %k2
	vmovdqa32	%zmm0, %zmm2 {%k2}
	vmovdqa32	%zmm1, %zmm0 {%k1} {z}
	vcmpltps	%zmm0, %zmm2, %k2
	vmovdqa32	%zmm2, %zmm0 {%k2}
	vblendmps	%zmm0, %zmm1, %zmm0 {%k1}
	vmovups	%zmm0, -64(%r8) {%k7}
	vmovups	%zmm1, (%r8) {%k7}
	movl	$2, %r8d
	jmp	.LBB0_11
	.p2align	4
.LBB0_24:
	kmovw	544(%rsp), %k7
	incq	%r8
	movabsq	$FACTORS, %r13
	cmpq	$6, %r8
	je	.LBB0_25
.LBB0_11:
	leaq	(,%r8,8), %rbx
	movq	%r8, %r15
	shlq	$6, %r15
	movq	%r15, %r12
	negq	%r12
	subq	%r8, %rbx
	vbroadcastss	(%r13,%rbx,4), %zmm0
	vbroadcastss	4(%r13,%rbx,4), %zmm1
	vbroadcastss	8(%r13,%rbx,4), %zmm2
	vmulps	4352(%rsp,%r12), %zmm0, %zmm0
	movl	$1, %r12d
	subq	%r8, %r12
	shlq	$6, %r12
	vmulps	4352(%rsp,%r12), %zmm1, %zmm1
	movl	$2, %r12d
	subq	%r8, %r12
	shlq	$6, %r12
	vmovups	%zmm0, 5312(%rsp) {%k7}
	vpbroadcastq	%r8, %zmm0
	vpcmpneqq	3072(%rsp), %zmm0, %k0
	vmovups	%zmm1, -256(%r10) {%k7}
	vmulps	4352(%rsp,%r12), %zmm2, %zmm1
	kunpckbw	%k0, %k0, %k0
	kandw	%k0, %k7, %k1
	kortestw	%k1, %k1
	vmovups	%zmm1, -192(%r10) {%k7}
	je	.LBB0_13
	vmovss	12(%r13,%rbx,4), %xmm1
.LBB0_13:
	movl	$3, %r12d
	vbroadcastss	%xmm1, %zmm1
	subq	%r8, %r12
	shlq	$6, %r12
	vmulps	4352(%rsp,%r12), %zmm1, %zmm1
	movabsq	$.LCPI0_33, %r12
	vpcmpneqq	(%r12){1to8}, %zmm0, %k0
	kunpckbw	%k0, %k0, %k0
	vmovups	%zmm1, -128(%r10) {%k1}
	kandw	%k0, %k1, %k1
	kortestw	%k1, %k1
	je	.LBB0_15
	vmovss	16(%r13,%rbx,4), %xmm1
.LBB0_15:
	movl	$4, %r12d
	vbroadcastss	%xmm1, %zmm1
	subq	%r8, %r12
	shlq	$6, %r12
	vmulps	4352(%rsp,%r12), %zmm1, %zmm1
	movabsq	$.LCPI0_34, %r12
	vpcmpneqq	(%r12){1to8}, %zmm0, %k0
	kunpckbw	%k0, %k0, %k0
	vmovups	%zmm1, -64(%r10) {%k1}
	kandw	%k0, %k1, %k1
	kortestw	%k1, %k1
	je	.LBB0_17
	vmovss	20(%r13,%rbx,4), %xmm0
.LBB0_17:
	movl	$5, %ebx
	vbroadcastss	%xmm0, %zmm0
	leaq	-2(%r8), %r13
	vmovups	6656(%rsp,%r15), %zmm4
	subq	%r8, %rbx
	shlq	$6, %rbx
	vmulps	4352(%rsp,%rbx), %zmm0, %zmm0
	leaq	-1(%r8), %rbx
	movq	%rbx, %r12
	shlq	$6, %r12
	vmovups	%zmm4, 6720(%rsp,%r15) {%k7}
	vmovups	%zmm0, (%r10) {%k1}
	vmovups	5312(%rsp,%r12), %zmm3
	vmovups	5312(%rsp,%r15), %zmm2
	movq	%r13, %r12
	shlq	$6, %r12
	cmpq	$2, %rbx
	vmovups	5056(%rsp,%r15), %zmm1
	vmovups	4992(%rsp,%r15), %zmm0
	movl	$1, %r15d
	vmovups	5312(%rsp,%r12), %zmm5
	sbbl	%ebx, %ebx
	notl	%ebx
	kmovd	%ebx, %k0
	leaq	-3(%r8), %rbx
	movq	%rbx, %r12
	shlq	$6, %r12
	cmpq	$2, %r13
	kandw	%k0, %k7, %k2
	kmovw	%k0, 64(%rsp)
	kmovw	%k2, 384(%rsp)
	vsubps	%zmm2, %zmm3, %zmm7
	vsubps	%zmm7, %zmm5, %zmm8
	vmovups	5312(%rsp,%r12), %zmm7
	sbbl	%r12d, %r12d
	cmpq	$2, %rbx
	notl	%r12d
	sbbl	%ebx, %ebx
	kmovd	%r12d, %k4
	notl	%ebx
	kmovd	%ebx, %k0
	kandw	%k4, %k2, %k1
	kandw	%k0, %k1, %k1
	kmovw	%k0, 448(%rsp)
	kmovw	%k1, 320(%rsp)
	vsubps	%zmm8, %zmm7, %zmm9
	vsubps	%zmm9, %zmm1, %zmm10
	vmovaps	%zmm10, %zmm9 {%k4}
	vmovaps	%zmm9, %zmm8 {%k2}
	vmovups	1408(%rsp), %zmm9
	vsubps	%zmm10, %zmm0, %zmm8 {%k1}
	jmp	.LBB0_18
	.p2align	4
.LBB0_23:
	vmovaps	%zmm13, %zmm12 {%k1}
	kmovw	256(%rsp), %k1
	leaq	6656(%rsp,%r12), %rbx
	vmovaps	%zmm10, %zmm9
	vmovaps	%zmm11, %zmm8
	vmovups	%zmm12, (%rbx) {%k1}
	cmpq	%r8, %r15
	leaq	1(%r15), %r15
	je	.LBB0_24
.LBB0_18:
	movq	%r15, %r12
	shlq	$6, %r12
	kmovw	384(%rsp), %k1
	vmovups	2048(%rsp), %zmm4
	vmovups	6656(%rsp,%r12), %zmm10
	vmulps	%zmm2, %zmm10, %zmm11
	vsubps	%zmm9, %zmm10, %zmm21
	vcmpgtps	(%rdx){1to16}, %zmm21, %k3
	vaddps	%zmm3, %zmm11, %zmm11
	vmulps	%zmm11, %zmm10, %zmm11
	vaddps	%zmm5, %zmm11, %zmm11
	vmulps	%zmm11, %zmm10, %zmm12
	vaddps	%zmm7, %zmm12, %zmm12
	vmulps	%zmm12, %zmm10, %zmm13
	vaddps	%zmm1, %zmm13, %zmm13
	vmovaps	%zmm13, %zmm12 {%k4}
	vmovaps	%zmm12, %zmm11 {%k1}
	kmovw	320(%rsp), %k1
	vmulps	%zmm13, %zmm10, %zmm14
	vxorps	%xmm13, %xmm13, %xmm13
	vaddps	%zmm10, %zmm9, %zmm12
	vmulps	%zmm16, %zmm12, %zmm12
	vaddps	%zmm0, %zmm14, %zmm11 {%k1}
	vcmpltps	%zmm13, %zmm8, %k1
	vaddps	%zmm11, %zmm8, %zmm14
	vmulps	(%r11){1to16}, %zmm14, %zmm14
	vsubps	%zmm11, %zmm8, %zmm15
	vcmpltps	%zmm13, %zmm11, %k2
	kxorw	%k2, %k1, %k1
	vcmpgeps	576(%rsp), %zmm4, %k1 {%k1}
	vdivps	%zmm15, %zmm14, %zmm14
	kmovw	%k1, 256(%rsp)
	kandw	%k3, %k1, %k1
	kortestw	%k1, %k1
	vmulps	%zmm14, %zmm21, %zmm14
	vaddps	%zmm14, %zmm12, %zmm12
	je	.LBB0_23
	vmovups	(%rcx), %zmm14
	vmovups	(%r9), %zmm15
	vmovaps	%zmm12, %zmm19
	vmovaps	%zmm12, %zmm22
	xorl	%ebx, %ebx
	vmovaps	%zmm12, %zmm28
	vpermt2ps	%zmm21, %zmm14, %zmm19
	vpermt2ps	%zmm21, %zmm15, %zmm22
	vmovaps	%zmm9, %zmm21
	vpermt2ps	%zmm10, %zmm14, %zmm21
	vpermt2ps	%zmm10, %zmm15, %zmm9
	jmp	.LBB0_20
	.p2align	4
.LBB0_22:
	kmovd	%edi, %k2
	vpmovm2w	%k7, %zmm17
	vpmovsxwd	%ymm17, %zmm17
	vmovaps	%zmm28, %zmm13 {%k3}
	kandw	%k6, %k3, %k3
	incl	%ebx
	vblendmps	%zmm9, %zmm22, %zmm6 {%k2}
	vpermt2ps	%zmm22, %zmm24, %zmm9
	vblendmps	%zmm21, %zmm19, %zmm4 {%k2}
	vmovaps	%zmm28, %zmm22
	vpermt2ps	%zmm19, %zmm24, %zmm21
	vmovaps	%zmm28, %zmm19
	vpermt2ps	%zmm30, %zmm14, %zmm19
	vpermt2ps	%zmm30, %zmm15, %zmm22
	ktestw	%k1, %k3
	vpmovw2m	%zmm17, %k2
	vmovaps	%zmm6, %zmm9 {%k2}
	kshiftrd	$16, %k2, %k2
	vmovaps	%zmm4, %zmm21 {%k2}
	je	.LBB0_23
.LBB0_20:
	vmovaps	%zmm28, %zmm30
	vmulps	%zmm20, %zmm28, %zmm28
	vmulps	%zmm2, %zmm30, %zmm31
	kmovw	64(%rsp), %k0
	kmovw	448(%rsp), %k5
	kandw	%k3, %k1, %k6
	vcmpltps	%zmm20, %zmm8, %k7
	vaddps	%zmm28, %zmm2, %zmm28
	vaddps	%zmm3, %zmm31, %zmm31
	kandw	%k0, %k6, %k2
	vmulps	%zmm28, %zmm30, %zmm28
	kandw	%k4, %k2, %k0
	kandw	%k5, %k0, %k5
	vaddps	%zmm28, %zmm31, %zmm28
	vmulps	%zmm31, %zmm30, %zmm31
	vaddps	%zmm5, %zmm31, %zmm31
	vmulps	%zmm28, %zmm30, %zmm6
	vmulps	%zmm31, %zmm30, %zmm29
	vaddps	%zmm6, %zmm31, %zmm6
	vaddps	%zmm7, %zmm29, %zmm29
	vmulps	%zmm6, %zmm30, %zmm17
	vmulps	%zmm29, %zmm30, %zmm4
	vaddps	%zmm17, %zmm29, %zmm17
	vaddps	%zmm1, %zmm4, %zmm4
	vmulps	%zmm17, %zmm30, %zmm26
	vmovaps	%zmm17, %zmm6 {%k4}
	vmovaps	%zmm6, %zmm28 {%k2}
	vmovaps	%zmm9, %zmm6
	vpermt2ps	%zmm21, %zmm25, %zmm6
	vmulps	%zmm4, %zmm30, %zmm18
	vmovaps	%zmm4, %zmm29 {%k4}
	vmovaps	%zmm29, %zmm31 {%k2}
	vaddps	%zmm26, %zmm4, %zmm28 {%k5}
	vmovaps	%zmm9, %zmm4
	vpermt2ps	%zmm21, %zmm23, %zmm4
	vaddps	%zmm0, %zmm18, %zmm31 {%k5}
	vdivps	%zmm28, %zmm31, %zmm17
	vcmpnltps	%zmm20, %zmm31, %k0
	kxorw	%k7, %k0, %k0
	kandw	%k0, %k6, %k7
	vblendmps	%zmm6, %zmm30, %zmm6 {%k7}
	vmovaps	%zmm30, %zmm4 {%k7}
	vsubps	%zmm17, %zmm30, %zmm28
	vcmpnleps	%zmm28, %zmm4, %k0
	vcmpnleps	%zmm6, %zmm28, %k2
	vaddps	%zmm4, %zmm6, %zmm4
	korw	%k2, %k0, %k2
	vmulps	%zmm16, %zmm4, %zmm28 {%k2}
	vsubps	%zmm30, %zmm28, %zmm4
	vandps	(%rax){1to16}, %zmm4, %zmm30 {%k6} {z}
	vcmpgtps	%zmm27, %zmm30, %k6
	cmpl	$63, %ebx
	jb	.LBB0_22
	kxorw	%k0, %k0, %k6
	jmp	.LBB0_22
	.p2align	4
.LBB0_25:
	vcmpngtps	960(%rsp), %zmm20, %k0
	vmovups	4032(%rsp), %zmm3
	vmovups	4096(%rsp), %zmm2
	vmovups	4160(%rsp), %zmm30
	vmovups	4224(%rsp), %zmm21
	kmovw	704(%rsp), %k1
	movq	208(%rsp), %r12
	kxorw	%k1, %k0, %k2
.LBB0_26:
	vmovups	6848(%rsp), %zmm1
	vmovups	6720(%rsp), %zmm0
	vmovups	1728(%rsp), %zmm5
	vmovups	896(%rsp), %zmm15
	vmovups	1344(%rsp), %zmm19
	vmovups	1920(%rsp), %zmm26
	vmovups	1856(%rsp), %zmm28
	vmovups	1984(%rsp), %zmm22
	vmovups	2240(%rsp), %zmm29
	vmovups	1792(%rsp), %zmm31
	vmovups	1600(%rsp), %zmm13
	vmovups	%zmm2, 256(%rsp)
	vmovups	1408(%rsp), %zmm18
	vmovups	%zmm3, 448(%rsp)
	vmovups	832(%rsp), %zmm3
	vmovups	1536(%rsp), %zmm17
	movabsq	$.LCPI0_43, %r8
	kandw	%k2, %k7, %k1
	vmovups	6784(%rsp), %zmm7
	vxorps	%xmm11, %xmm11, %xmm11
	vmovups	%zmm1, 64(%rsp)
	vmovups	6912(%rsp), %zmm1
	vmovups	%zmm1, 384(%rsp)
	vmulps	%zmm0, %zmm5, %zmm1
	vblendmps	%zmm0, %zmm18, %zmm0 {%k1}
	vaddps	%zmm1, %zmm15, %zmm1
	vmulps	%zmm1, %zmm19, %zmm6
	vmulps	%zmm1, %zmm26, %zmm2
	vmulps	%zmm1, %zmm22, %zmm1
	vaddps	%zmm6, %zmm28, %zmm6
	vaddps	%zmm1, %zmm29, %zmm1
	vaddps	%zmm2, %zmm31, %zmm2
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm1, %zmm1, %zmm1
	vmulps	%zmm2, %zmm2, %zmm2
	vmulps	%zmm13, %zmm6, %zmm8
	vmulps	%zmm13, %zmm1, %zmm9
	vmulps	%zmm13, %zmm2, %zmm4
	vsubps	%zmm1, %zmm8, %zmm8
	vaddps	%zmm1, %zmm6, %zmm1
	vsubps	%zmm2, %zmm9, %zmm9
	vsubps	%zmm6, %zmm4, %zmm4
	vaddps	%zmm1, %zmm2, %zmm1
	vmulps	%zmm9, %zmm8, %zmm8
	vmovdqu64	3584(%rsp), %zmm2
	vaddps	%zmm18, %zmm1, %zmm1
	vmulps	%zmm8, %zmm4, %zmm4
	vmulps	%zmm1, %zmm1, %zmm1
	vmulps	%zmm3, %zmm4, %zmm4
	vmulps	%zmm17, %zmm1, %zmm1
	vsubps	%zmm1, %zmm4, %zmm1
	vpblendmd	(%r8){1to16}, %zmm2, %zmm4 {%k1}
	vmovups	960(%rsp), %zmm14
	kmovw	704(%rsp), %k2
	vmovups	%zmm15, 896(%rsp)
	vblendmps	%zmm1, %zmm14, %zmm2 {%k1}
	vmulps	%zmm7, %zmm5, %zmm1
	vcmpnltps	%zmm11, %zmm2, %k0
	vaddps	%zmm1, %zmm15, %zmm1
	kxorw	%k2, %k0, %k0
	kandw	%k0, %k7, %k1
	vmovaps	%zmm2, %zmm14 {%k1}
	vmulps	%zmm1, %zmm19, %zmm9
	vmulps	%zmm1, %zmm26, %zmm6
	vmulps	%zmm1, %zmm22, %zmm1
	vaddps	%zmm9, %zmm28, %zmm9
	vaddps	%zmm1, %zmm29, %zmm1
	vaddps	%zmm6, %zmm31, %zmm6
	vmulps	%zmm9, %zmm9, %zmm9
	vmulps	%zmm1, %zmm1, %zmm1
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm13, %zmm9, %zmm10
	vmulps	%zmm13, %zmm1, %zmm12
	vmulps	%zmm13, %zmm6, %zmm8
	vsubps	%zmm1, %zmm10, %zmm10
	vaddps	%zmm1, %zmm9, %zmm1
	vsubps	%zmm6, %zmm12, %zmm12
	vsubps	%zmm9, %zmm8, %zmm8
	vaddps	%zmm1, %zmm6, %zmm1
	vmulps	%zmm12, %zmm10, %zmm10
	vaddps	%zmm18, %zmm1, %zmm1
	vmulps	%zmm10, %zmm8, %zmm8
	vmulps	%zmm1, %zmm1, %zmm1
	vmulps	%zmm3, %zmm8, %zmm8
	vmulps	%zmm17, %zmm1, %zmm6
	vpmovm2d	%k1, %zmm1
	vpsubd	%zmm1, %zmm4, %zmm4
	vblendmps	%zmm0, %zmm18, %zmm1 {%k1}
	vmovaps	%zmm7, %zmm0 {%k1}
	vmulps	64(%rsp), %zmm5, %zmm7
	vsubps	%zmm6, %zmm8, %zmm2 {%k1}
	vcmpnltps	%zmm11, %zmm2, %k0
	kxorw	%k2, %k0, %k0
	kandw	%k0, %k7, %k1
	vaddps	%zmm7, %zmm15, %zmm6
	vmovaps	%zmm2, %zmm14 {%k1}
	vmovaps	%zmm0, %zmm1 {%k1}
	vmovups	64(%rsp), %zmm0 {%k1}
	vmulps	%zmm6, %zmm26, %zmm7
	vmulps	%zmm6, %zmm19, %zmm9
	vmulps	%zmm6, %zmm22, %zmm6
	vaddps	%zmm9, %zmm28, %zmm9
	vaddps	%zmm6, %zmm29, %zmm6
	vaddps	%zmm7, %zmm31, %zmm7
	vmulps	%zmm9, %zmm9, %zmm9
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm7, %zmm7, %zmm7
	vmulps	%zmm13, %zmm9, %zmm10
	vmulps	%zmm13, %zmm6, %zmm12
	vmulps	%zmm13, %zmm7, %zmm8
	vsubps	%zmm6, %zmm10, %zmm10
	vsubps	%zmm7, %zmm12, %zmm12
	vsubps	%zmm9, %zmm8, %zmm8
	vaddps	%zmm6, %zmm9, %zmm6
	vmulps	%zmm12, %zmm10, %zmm10
	vaddps	%zmm6, %zmm7, %zmm6
	vmovaps	%zmm5, %zmm12
	vpmovm2d	%k1, %zmm7
	vpsubd	%zmm7, %zmm4, %zmm4
	vmovdqu64	%zmm4, 320(%rsp)
	vmovups	832(%rsp), %zmm4
	vmulps	%zmm10, %zmm8, %zmm8
	vaddps	%zmm18, %zmm6, %zmm6
	vmulps	%zmm3, %zmm8, %zmm8
	vmovups	384(%rsp), %zmm3
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm17, %zmm6, %zmm6
	vsubps	%zmm6, %zmm8, %zmm6
	vmulps	%zmm3, %zmm5, %zmm5
	vmovaps	%zmm6, %zmm2 {%k1}
	vcmpnltps	%zmm11, %zmm2, %k0
	vaddps	%zmm5, %zmm15, %zmm5
	kxorw	%k2, %k0, %k0
	vmovups	256(%rsp), %zmm15
	kandw	%k0, %k7, %k1
	vmovaps	%zmm0, %zmm1 {%k1}
	vmovaps	%zmm3, %zmm0 {%k1}
	vmovups	6976(%rsp), %zmm3
	vmovaps	%zmm2, %zmm14 {%k1}
	vmulps	%zmm5, %zmm19, %zmm8
	vmulps	%zmm5, %zmm26, %zmm6
	vmulps	%zmm5, %zmm22, %zmm5
	vaddps	%zmm8, %zmm28, %zmm8
	vaddps	%zmm6, %zmm31, %zmm6
	vaddps	%zmm5, %zmm29, %zmm5
	vmulps	%zmm8, %zmm8, %zmm8
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm5, %zmm5, %zmm5
	vmulps	%zmm13, %zmm8, %zmm9
	vmulps	%zmm13, %zmm6, %zmm7
	vmulps	%zmm13, %zmm5, %zmm10
	vsubps	%zmm5, %zmm9, %zmm9
	vaddps	%zmm5, %zmm8, %zmm5
	vsubps	%zmm8, %zmm7, %zmm7
	vmovdqu64	320(%rsp), %zmm8
	vsubps	%zmm6, %zmm10, %zmm10
	vaddps	%zmm5, %zmm6, %zmm5
	vpmovm2d	%k1, %zmm6
	vmulps	%zmm10, %zmm9, %zmm9
	vaddps	%zmm18, %zmm5, %zmm5
	vmulps	%zmm9, %zmm7, %zmm7
	vpsubd	%zmm6, %zmm8, %zmm6
	vmulps	%zmm5, %zmm5, %zmm5
	vmovdqu64	%zmm6, 64(%rsp)
	vmulps	%zmm3, %zmm12, %zmm6
	vmulps	%zmm4, %zmm7, %zmm7
	vmulps	%zmm17, %zmm5, %zmm5
	vmovaps	%zmm12, %zmm17
	vmovups	896(%rsp), %zmm12
	vsubps	%zmm5, %zmm7, %zmm2 {%k1}
	vcmpnltps	%zmm11, %zmm2, %k0
	vaddps	%zmm6, %zmm12, %zmm5
	kxorw	%k2, %k0, %k0
	kandw	%k0, %k7, %k1
	vmovaps	%zmm2, %zmm14 {%k1}
	vmovaps	%zmm0, %zmm1 {%k1}
	vmovaps	%zmm3, %zmm0 {%k1}
	vmulps	%zmm5, %zmm26, %zmm6
	vmulps	%zmm5, %zmm19, %zmm8
	vmulps	%zmm5, %zmm22, %zmm5
	vaddps	%zmm8, %zmm28, %zmm8
	vaddps	%zmm5, %zmm29, %zmm5
	vaddps	%zmm6, %zmm31, %zmm6
	vmulps	%zmm8, %zmm8, %zmm8
	vmulps	%zmm5, %zmm5, %zmm5
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm13, %zmm8, %zmm9
	vmulps	%zmm13, %zmm5, %zmm10
	vmulps	%zmm13, %zmm6, %zmm7
	vsubps	%zmm5, %zmm9, %zmm9
	vsubps	%zmm6, %zmm10, %zmm10
	vsubps	%zmm8, %zmm7, %zmm7
	vaddps	%zmm5, %zmm8, %zmm5
	vmulps	%zmm10, %zmm9, %zmm9
	vaddps	%zmm5, %zmm6, %zmm5
	vpmovm2d	%k1, %zmm6
	vmulps	%zmm9, %zmm7, %zmm7
	vaddps	%zmm18, %zmm5, %zmm5
	vmulps	%zmm4, %zmm7, %zmm7
	vmovups	1536(%rsp), %zmm4
	vmulps	%zmm5, %zmm5, %zmm5
	vmulps	%zmm4, %zmm5, %zmm5
	vsubps	%zmm5, %zmm7, %zmm5
	vmovdqu64	64(%rsp), %zmm7
	vmovaps	%zmm5, %zmm2 {%k1}
	vmovups	7040(%rsp), %zmm5
	vcmpnltps	%zmm11, %zmm2, %k0
	kxorw	%k2, %k0, %k0
	kandw	%k0, %k7, %k1
	vmovaps	%zmm2, %zmm14 {%k1}
	vmovaps	%zmm0, %zmm1 {%k1}
	vpsubd	%zmm6, %zmm7, %zmm6
	vmovdqu64	%zmm6, 64(%rsp)
	vmulps	%zmm5, %zmm17, %zmm3
	vmovaps	%zmm5, %zmm0 {%k1}
	vsubps	%zmm1, %zmm0, %zmm5
	vcmpgtps	1664(%rsp), %zmm5, %k4
	vaddps	%zmm3, %zmm12, %zmm3
	vmulps	%zmm3, %zmm26, %zmm6
	vmulps	%zmm3, %zmm19, %zmm8
	vmulps	%zmm3, %zmm22, %zmm3
	vaddps	%zmm8, %zmm28, %zmm8
	vmovaps	%zmm29, %zmm28
	vaddps	%zmm3, %zmm28, %zmm3
	vaddps	%zmm6, %zmm31, %zmm6
	vmovups	448(%rsp), %zmm29
	vmovups	768(%rsp), %zmm31
	vmulps	%zmm8, %zmm8, %zmm8
	vmulps	%zmm3, %zmm3, %zmm3
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm13, %zmm8, %zmm9
	vmulps	%zmm13, %zmm3, %zmm10
	vmulps	%zmm13, %zmm6, %zmm7
	vxorps	%xmm13, %xmm13, %xmm13
	vsubps	%zmm3, %zmm9, %zmm9
	vsubps	%zmm6, %zmm10, %zmm10
	vaddps	%zmm3, %zmm8, %zmm3
	vsubps	%zmm8, %zmm7, %zmm7
	vmulps	%zmm10, %zmm9, %zmm9
	vaddps	%zmm3, %zmm6, %zmm3
	vmulps	%zmm9, %zmm7, %zmm7
	vmulps	832(%rsp), %zmm7, %zmm7
	vaddps	%zmm18, %zmm3, %zmm3
	vmulps	%zmm3, %zmm3, %zmm3
	vmulps	%zmm4, %zmm3, %zmm6
	vmovdqu64	64(%rsp), %zmm4
	vpmovm2d	%k1, %zmm3
	vsubps	%zmm6, %zmm7, %zmm2 {%k1}
	vaddps	%zmm2, %zmm14, %zmm6
	vmulps	(%r11){1to16}, %zmm6, %zmm6
	vcmpltps	%zmm11, %zmm2, %k0
	vsubps	%zmm2, %zmm14, %zmm2
	vpsubd	%zmm3, %zmm4, %zmm3
	vaddps	%zmm0, %zmm1, %zmm4
	kxorw	%k2, %k0, %k0
	kandw	%k0, %k7, %k2
	vmulps	%zmm16, %zmm4, %zmm4
	kandw	%k4, %k2, %k3
	kortestw	%k3, %k3
	vdivps	%zmm2, %zmm6, %zmm2
	vmulps	%zmm2, %zmm5, %zmm2
	vaddps	%zmm2, %zmm4, %zmm14
	vmulps	%zmm14, %zmm17, %zmm2
	vaddps	%zmm2, %zmm12, %zmm2
	je	.LBB0_31
	vmovups	(%rcx), %zmm7
	vmovups	(%r9), %zmm8
	vmovaps	%zmm1, %zmm9
	vmovaps	%zmm14, %zmm10
	vmovaps	%zmm14, %zmm12
	xorl	%r8d, %r8d
	vmovaps	%zmm2, %zmm19
	vpermt2ps	%zmm5, %zmm7, %zmm10
	vpermt2ps	%zmm5, %zmm8, %zmm12
	vpermt2ps	%zmm0, %zmm7, %zmm9
	vpermt2ps	%zmm0, %zmm8, %zmm1
	vmovdqa64	%zmm3, %zmm0
	jmp	.LBB0_28
	.p2align	4
.LBB0_30:
	kmovd	%edi, %k6
	vpmovm2w	%k5, %zmm17
	vpmovsxwd	%ymm17, %zmm17
	vpternlogd	$255, %zmm4, %zmm4, %zmm4
	incl	%r8d
	vblendmps	%zmm9, %zmm10, %zmm18 {%k6}
	vpermt2ps	%zmm10, %zmm24, %zmm9
	vmulps	1728(%rsp), %zmm14, %zmm10
	vblendmps	%zmm1, %zmm12, %zmm6 {%k6}
	vpermt2ps	%zmm12, %zmm24, %zmm1
	vmovaps	%zmm14, %zmm12
	vpermt2ps	%zmm22, %zmm8, %zmm12
	vpsubd	%zmm4, %zmm0, %zmm0
	vmovdqa32	%zmm0, %zmm13 {%k4}
	vaddps	896(%rsp), %zmm10, %zmm19
	vmovaps	%zmm14, %zmm10
	vpermt2ps	%zmm22, %zmm7, %zmm10
	vpmovw2m	%zmm17, %k5
	vmovaps	%zmm6, %zmm1 {%k5}
	kshiftrd	$16, %k5, %k5
	vmovaps	%zmm18, %zmm9 {%k5}
	vmovaps	%zmm19, %zmm11 {%k4}
	kandw	%k1, %k4, %k4
	ktestw	%k3, %k4
	je	.LBB0_31
.LBB0_28:
	vmulps	%zmm14, %zmm31, %zmm6
	vaddps	640(%rsp), %zmm6, %zmm6
	vmulps	%zmm20, %zmm14, %zmm4
	vmovaps	%zmm14, %zmm22
	vmulps	1920(%rsp), %zmm19, %zmm17
	vmovups	1600(%rsp), %zmm26
	movabsq	$.LCPI0_45, %rbx
	kmovw	704(%rsp), %k5
	kandw	%k4, %k3, %k1
	vaddps	%zmm4, %zmm31, %zmm4
	vaddps	1792(%rsp), %zmm17, %zmm17
	vmulps	%zmm4, %zmm14, %zmm4
	vaddps	%zmm4, %zmm6, %zmm4
	vmulps	%zmm6, %zmm14, %zmm6
	vaddps	%zmm6, %zmm21, %zmm6
	vmulps	%zmm4, %zmm14, %zmm4
	vmulps	%zmm17, %zmm17, %zmm17
	vaddps	%zmm4, %zmm6, %zmm4
	vmulps	%zmm6, %zmm14, %zmm6
	vaddps	%zmm6, %zmm30, %zmm6
	vmulps	%zmm4, %zmm14, %zmm4
	vaddps	%zmm4, %zmm6, %zmm4
	vmulps	%zmm6, %zmm14, %zmm6
	vaddps	%zmm6, %zmm15, %zmm6
	vmulps	%zmm4, %zmm14, %zmm4
	vaddps	%zmm4, %zmm6, %zmm4
	vmulps	%zmm6, %zmm14, %zmm6
	vmulps	%zmm4, %zmm14, %zmm4
	vaddps	%zmm6, %zmm29, %zmm6
	vmulps	1344(%rsp), %zmm19, %zmm14
	vaddps	%zmm4, %zmm6, %zmm4
	vaddps	1856(%rsp), %zmm14, %zmm6
	vmulps	1984(%rsp), %zmm19, %zmm14
	vaddps	%zmm14, %zmm28, %zmm14
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm14, %zmm14, %zmm14
	vmulps	%zmm26, %zmm6, %zmm18
	vmulps	%zmm26, %zmm14, %zmm19
	vsubps	%zmm14, %zmm18, %zmm18
	vmulps	%zmm26, %zmm17, %zmm26
	vsubps	%zmm17, %zmm19, %zmm19
	vmulps	%zmm19, %zmm18, %zmm18
	vsubps	%zmm6, %zmm26, %zmm19
	vaddps	%zmm14, %zmm6, %zmm6
	vmovaps	%zmm1, %zmm14
	vpermt2ps	%zmm9, %zmm25, %zmm14
	vaddps	%zmm6, %zmm17, %zmm6
	vaddps	1408(%rsp), %zmm6, %zmm6
	vmulps	%zmm18, %zmm19, %zmm18
	vmulps	832(%rsp), %zmm18, %zmm18
	vmovaps	%zmm1, %zmm17
	vpermt2ps	%zmm9, %zmm23, %zmm17
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	(%rbx){1to16}, %zmm6, %zmm6
	vaddps	%zmm6, %zmm18, %zmm6
	vdivps	%zmm4, %zmm6, %zmm4
	vcmpnltps	%zmm20, %zmm6, %k0
	kxorw	%k5, %k0, %k0
	kandw	%k0, %k1, %k5
	vblendmps	%zmm14, %zmm22, %zmm18 {%k5}
	vmovaps	%zmm22, %zmm17 {%k5}
	vsubps	%zmm4, %zmm22, %zmm14
	vaddps	%zmm17, %zmm18, %zmm4
	vcmpnleps	%zmm14, %zmm17, %k0
	vcmpnleps	%zmm18, %zmm14, %k6
	korw	%k6, %k0, %k6
	vmulps	%zmm16, %zmm4, %zmm14 {%k6}
	vsubps	%zmm22, %zmm14, %zmm4
	vandps	(%rax){1to16}, %zmm4, %zmm22 {%k1} {z}
	vcmpgtps	1664(%rsp), %zmm22, %k1
	cmpl	$63, %r8d
	jb	.LBB0_30
	kxorw	%k0, %k0, %k1
	jmp	.LBB0_30
.Lfunc_end0:
	.size	camera, .Lfunc_end0-camera

	.type	NODES,@object
	.section	.lrodata,"al",@progbits
	.globl	NODES
	.p2align	2, 0x0
NODES:
	.long	0xbf800000
	.long	0xbf5db3d7
	.long	0xbf000000
	.long	0x00000000
	.long	0x3f000000
	.long	0x3f5db3d7
	.long	0x3f800000
	.size	NODES, 28

	.type	EVEN_HI,@object
	.globl	EVEN_HI
	.p2align	2, 0x0
EVEN_HI:
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x3f800000
	.long	0x3efffffe
	.long	0xbfaaaaaa
	.long	0x40800000
	.long	0xc0caaaab
	.long	0xc02aaaa9
	.long	0x40d55555
	.long	0xc1155556
	.long	0x412aaaab
	.long	0x402aaaa9
	.long	0xc0aaaaaa
	.long	0x40aaaaab
	.long	0xc0aaaaab
	.size	EVEN_HI, 64

	.type	EVEN_LO,@object
	.globl	EVEN_LO
	.p2align	2, 0x0
EVEN_LO:
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0xb2516497
	.long	0xb36e8cf6
	.long	0x339a2c95
	.long	0x33ee8cf2
	.long	0xb324ecee
	.long	0x3328c0cc
	.long	0x34949d9c
	.long	0xb3a8c0bc
	.long	0x33eca30a
	.long	0xb46e8cf6
	.long	0x3409ae7e
	.long	0xb30b986d
	.size	EVEN_LO, 64

	.type	ODD_HI,@object
	.globl	ODD_HI
	.p2align	2, 0x0
ODD_HI:
	.long	0x3efffffe
	.long	0xbf93cd3a
	.long	0x40000000
	.long	0xc02aaaa9
	.long	0x40b8c088
	.long	0xc0955556
	.long	0x402aaaa9
	.long	0xc093cd3a
	.long	0x402aaaab
	.size	ODD_HI, 36

	.type	ODD_LO,@object
	.globl	ODD_LO
	.p2align	2, 0x0
ODD_LO:
	.long	0xb2516497
	.long	0x32b2065e
	.long	0x331a2c95
	.long	0xb324ecee
	.long	0x3410bc05
	.long	0x34149d9c
	.long	0x33eca30a
	.long	0x33b2065e
	.long	0x3389ae7e
	.size	ODD_LO, 36

	.type	FACTORS,@object
	.globl	FACTORS
	.p2align	2, 0x0
FACTORS:
	.long	0x3f800000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x3f800000
	.long	0x40c00000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x3f800000
	.long	0x40a00000
	.long	0x41700000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x3f800000
	.long	0x40800000
	.long	0x41200000
	.long	0x41a00000
	.long	0x00000000
	.long	0x00000000
	.long	0x00000000
	.long	0x3f800000
	.long	0x40400000
	.long	0x40c00000
	.long	0x41200000
	.long	0x41700000
	.long	0x00000000
	.long	0x00000000
	.long	0x3f800000
	.long	0x40000000
	.long	0x40400000
	.long	0x40800000
	.long	0x40a00000
	.long	0x40c00000
	.long	0x00000000
	.long	0x3f800000
	.long	0x3f800000
	.long	0x3f800000
	.long	0x3f800000
	.long	0x3f800000
	.long	0x3f800000
	.long	0x3f800000
	.size	FACTORS, 196

	.type	float_const_signMask,@object
	.globl	float_const_signMask
	.p2align	2, 0x0
float_const_signMask:
	.long	2147483647
	.size	float_const_signMask, 4

	.ident	"Intel(R) oneAPI DPC++/C++ Compiler 2026.2.0 (2026.2.0.20261001)"
	.section	".note.GNU-stack","",@progbits
